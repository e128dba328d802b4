// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Decompositions that keep their memory. Eigen's matrices give it back when their shape changes, so that each shape has its own.
#include <Eigen/QR>
#include <algorithm>

#include "math/dense.h"

namespace codesign {
namespace {

using Orthogonal = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;

/// A decomposition, and the matrix that it is of.
template <class Factors>
struct Decomposed {
  Decomposed(Eigen::Index rows, Eigen::Index columns) : A(rows, columns) {}
  Eigen::MatrixXd A;
  Factors factors;
};

template <class Factors>
struct Decompositions {
  using Shape = Decomposed<Factors>;
  std::vector<std::unique_ptr<Shape>> shapes;
  Shape* now = nullptr;  ///< the one in use

  Eigen::MatrixXd& matrix(Eigen::Index rows, Eigen::Index columns) {
    const auto found = std::find_if(shapes.begin(), shapes.end(),
                                    [&](const auto& shape) { return shape->A.rows() == rows && shape->A.cols() == columns; });
    now = found == shapes.end() ? shapes.emplace_back(std::make_unique<Shape>(rows, columns)).get() : found->get();
    return now->A;
  }
  void factor(double threshold) {
    now->factors.setThreshold(threshold);
    now->factors.compute(now->A);
  }
};

/// x = P Z^T (z, 0) for the first `rank` rows z of y, as Eigen's solve() does it. @param reflection workspace.
void undo_columns(const Orthogonal& factors, Eigen::VectorXd* reflection, Eigen::MatrixXd* y, Eigen::MatrixXd* x) {
  const Eigen::Index rank = factors.rank(), columns = factors.cols();
  for (Eigen::Index k = 0; rank < columns && k < rank; ++k) {
    if (k != rank - 1) y->row(k).swap(y->row(rank - 1));
    y->middleRows(rank - 1, columns - rank + 1)
        .applyHouseholderOnTheLeft(factors.matrixQTZ().row(k).tail(columns - rank).adjoint(), factors.zCoeffs()(k), reflection->data());
    if (k != rank - 1) y->row(k).swap(y->row(rank - 1));
  }
  const auto& order = factors.colsPermutation().indices();
  for (Eigen::Index k = 0; k < columns; ++k) x->row(order[k]) = y->row(k);
}

}  // namespace

struct PivotedQr::Implementation : Decompositions<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> {
  Eigen::MatrixXd Q;
  Eigen::VectorXd reflection;
};

PivotedQr::PivotedQr() : implementation_(std::make_unique<Implementation>()) {}
PivotedQr::~PivotedQr() = default;
PivotedQr::PivotedQr(PivotedQr&&) noexcept = default;
PivotedQr& PivotedQr::operator=(PivotedQr&&) noexcept = default;

Eigen::MatrixXd& PivotedQr::matrix(Eigen::Index rows, Eigen::Index columns) { return implementation_->matrix(rows, columns); }
void PivotedQr::factor(double threshold) { implementation_->factor(threshold); }
Eigen::Index PivotedQr::rank() const { return implementation_->now->factors.rank(); }
int PivotedQr::column(Eigen::Index k) const { return implementation_->now->factors.colsPermutation().indices()[k]; }

void PivotedQr::complement(Eigen::MatrixXd* basis) {
  Implementation& to = *implementation_;
  to.now->factors.householderQ().evalTo(to.Q, to.reflection);
  *basis = to.Q.rightCols(to.now->A.rows() - rank());
}

struct LeastNormWorkspace::Solution {
  Solution(Eigen::Index rows, Eigen::Index columns, Eigen::Index count)
      : rotated(rows, count), y(columns, count), x(columns, count), row(count), reflection(std::max(columns, count)) {}
  Eigen::MatrixXd rotated, y, x;
  Eigen::RowVectorXd row;
  Eigen::VectorXd reflection;
};

LeastNormWorkspace::LeastNormWorkspace() = default;
LeastNormWorkspace::~LeastNormWorkspace() = default;
LeastNormWorkspace::LeastNormWorkspace(LeastNormWorkspace&&) noexcept = default;
LeastNormWorkspace& LeastNormWorkspace::operator=(LeastNormWorkspace&&) noexcept = default;

struct LeastNorm::Implementation : Decompositions<Orthogonal> {};

LeastNorm::LeastNorm() : implementation_(std::make_unique<Implementation>()) {}
LeastNorm::LeastNorm(const Eigen::MatrixXd& A, double threshold) : LeastNorm() {
  matrix(A.rows(), A.cols()) = A;
  factor(threshold);
}
LeastNorm::~LeastNorm() = default;
LeastNorm::LeastNorm(LeastNorm&&) noexcept = default;
LeastNorm& LeastNorm::operator=(LeastNorm&&) noexcept = default;

Eigen::MatrixXd& LeastNorm::matrix(Eigen::Index rows, Eigen::Index columns) { return implementation_->matrix(rows, columns); }
void LeastNorm::factor(double threshold) { implementation_->factor(threshold); }
Eigen::Index LeastNorm::rank() const { return implementation_->now->factors.rank(); }

Eigen::MatrixXd LeastNorm::solve(const Eigen::MatrixXd& b) const {
  LeastNormWorkspace workspace;
  return solve(b, &workspace);
}

// The operations of Eigen's solve(), in its order.
Eigen::MatrixXd& LeastNorm::solve(const Eigen::MatrixXd& b, LeastNormWorkspace* workspace) const {
  const Orthogonal& factors = implementation_->now->factors;
  auto& solutions = workspace->solutions_;
  const auto found = std::find_if(solutions.begin(), solutions.end(), [&](const auto& known) {
    return known->rotated.rows() == b.rows() && known->y.rows() == factors.cols() && known->y.cols() == b.cols();
  });
  LeastNormWorkspace::Solution& to =
      found != solutions.end()
          ? **found
          : *solutions.emplace_back(std::make_unique<LeastNormWorkspace::Solution>(b.rows(), factors.cols(), b.cols()));
  const Eigen::Index rank = factors.rank();
  if (rank == 0) {
    to.x.setZero();
    return to.x;
  }
  to.rotated = b;
  factors.matrixQ().setLength(rank).adjoint().applyThisOnTheLeft(to.rotated, to.row);
  to.y.topRows(rank) = factors.matrixT().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solve(to.rotated.topRows(rank));
  to.y.bottomRows(factors.cols() - rank).setZero();
  undo_columns(factors, &to.reflection, &to.y, &to.x);
  return to.x;
}

}  // namespace codesign
