// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Householder>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace codesign {
namespace {

using Qr = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

Qr factor(const Eigen::MatrixXd& A, double threshold) {
  Qr qr;
  qr.setThreshold(threshold);
  qr.compute(A);
  return qr;
}

unsigned options(SingularVectors vectors) {
  unsigned flags = 0;
  if (vectors == SingularVectors::kLeft || vectors == SingularVectors::kBoth)
    flags |= Eigen::ComputeFullU;
  if (vectors == SingularVectors::kRight || vectors == SingularVectors::kBoth)
    flags |= Eigen::ComputeFullV;
  return flags;
}

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
    const auto found = std::find_if(shapes.begin(), shapes.end(), [&](const auto& shape) {
      return shape->A.rows() == rows && shape->A.cols() == columns;
    });
    now = found == shapes.end() ? shapes.emplace_back(std::make_unique<Shape>(rows, columns)).get()
                                : found->get();
    return now->A;
  }
  void factor(double threshold) {
    now->factors.setThreshold(threshold);
    now->factors.compute(now->A);
  }
};

/// x = P Z^T (z, 0) for the first `rank` rows z of y, as Eigen's solve() does it. @param reflection
/// workspace.
void undo_columns(const Orthogonal& factors, Eigen::VectorXd* reflection, Eigen::MatrixXd* y,
                  Eigen::MatrixXd* x) {
  const Eigen::Index rank = factors.rank(), columns = factors.cols();
  for (Eigen::Index k = 0; rank < columns && k < rank; ++k) {
    if (k != rank - 1) y->row(k).swap(y->row(rank - 1));
    y->middleRows(rank - 1, columns - rank + 1)
        .applyHouseholderOnTheLeft(factors.matrixQTZ().row(k).tail(columns - rank).adjoint(),
                                   factors.zCoeffs()(k), reflection->data());
    if (k != rank - 1) y->row(k).swap(y->row(rank - 1));
  }
  const auto& order = factors.colsPermutation().indices();
  for (Eigen::Index k = 0; k < columns; ++k) x->row(order[k]) = y->row(k);
}

constexpr Eigen::Index kWaiting = 32;  // rows that wait for a reflection, at least

/// Replaces the first `used` rows of A by their triangular root, in the rows above; the rows below
/// it are left over.
/// @param workspace of the size of A's columns.
template <class Matrix>
void reduce(Eigen::Index used, Matrix* A, Eigen::VectorXd* workspace) {
  const Eigen::Index columns = A->cols();
  for (Eigen::Index k = 0; k < std::min(columns, used); ++k) {
    const Eigen::Index rows = used - k, right = columns - k - 1;
    auto column = A->col(k).segment(k, rows);
    double factor = 0.0, diagonal = 0.0;
    column.makeHouseholderInPlace(factor, diagonal);
    A->block(k, k + 1, rows, right)
        .applyHouseholderOnTheLeft(column.tail(rows - 1), factor, workspace->data());
    column.setZero();
    column[0] = diagonal;
    if (diagonal < 0.0) A->row(k).tail(right + 1) *= -1.0;
  }
}

}  // namespace

Eigen::MatrixXd about_mean_of(Eigen::MatrixXd columns) {
  if (columns.rows() > 0)
    for (auto column : columns.colwise()) column.array() -= column.mean();
  return columns;
}

SingularValues singular_values(const Eigen::MatrixXd& A, SingularVectors vectors) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, options(vectors));
  SingularValues result;
  result.values = svd.singularValues();
  if (svd.computeU()) result.U = svd.matrixU();
  if (svd.computeV()) result.V = svd.matrixV();
  return result;
}

PivotedColumns pivot_columns(const Eigen::MatrixXd& A, double threshold) {
  const Qr qr = factor(A, threshold);
  const auto& indices = qr.colsPermutation().indices();
  return {qr.rank(), std::vector<int>(indices.data(), indices.data() + indices.size()),
          qr.matrixQR().diagonal().cwiseAbs()};
}

struct PivotedLeastSquares::Implementation {
  Qr qr;
};

PivotedLeastSquares::PivotedLeastSquares(const Eigen::MatrixXd& A)
    : implementation_(std::make_unique<Implementation>()) {
  if (A.cols() > 0) implementation_->qr.compute(A);
}
PivotedLeastSquares::~PivotedLeastSquares() = default;
PivotedLeastSquares::PivotedLeastSquares(PivotedLeastSquares&&) noexcept = default;

Eigen::MatrixXd PivotedLeastSquares::solve(const Eigen::MatrixXd& b) const {
  if (implementation_->qr.cols() == 0) return Eigen::MatrixXd::Zero(0, b.cols());
  return implementation_->qr.solve(b);
}

double PivotedLeastSquares::explained(const Eigen::VectorXd& b) const {
  const Qr& qr = implementation_->qr;
  if (qr.cols() == 0) return 0.0;
  return (qr.householderQ().transpose() * b).head(qr.rank()).squaredNorm();
}

bool is_positive_definite(const Eigen::MatrixXd& A) { return A.llt().info() == Eigen::Success; }

Eigen::VectorXd solve_positive_definite(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.llt().solve(b);
}

Eigen::MatrixXd upper_factor(const Eigen::MatrixXd& A) {
  const Eigen::Index rows = std::min(A.rows(), A.cols());
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(A.cols(), A.cols());
  if (rows == 0) return R;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  R.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  for (Eigen::Index k = 0; k < rows; ++k)
    if (R(k, k) < 0.0) R.row(k) *= -1.0;
  return R;
}

Eigen::MatrixXd orthogonal_complement(const Eigen::MatrixXd& A, double threshold) {
  // Eigen's decomposition reads the first entry of a matrix that has none.
  if (A.cols() == 0) return Eigen::MatrixXd::Identity(A.rows(), A.rows());
  PivotedQr qr;
  qr.matrix(A.rows(), A.cols()) = A;
  qr.factor(threshold);
  Eigen::MatrixXd basis;
  qr.complement(&basis);
  return basis;
}

LeastNorm least_norm(const Eigen::MatrixXd& A) {
  return {A, least_norm_threshold(A.rows(), A.cols())};
}

double least_norm_threshold(Eigen::Index rows, Eigen::Index columns) {
  return Eigen::NumTraits<double>::epsilon() * static_cast<double>(std::min(rows, columns));
}

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

GeneralEigen general_eigen(const Eigen::MatrixXd& A) {
  if (A.size() == 0) return {};
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.transpose() * B;
}

Eigen::Vector3d principal_moments(const Eigen::Matrix3d& J) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J, Eigen::EigenvaluesOnly).eigenvalues();
}

// Decompositions that keep their memory. Eigen's matrices give it back when their shape changes, so
// that each shape has its own.

struct PivotedQr::Implementation : Decompositions<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> {
  Eigen::MatrixXd Q;
  Eigen::VectorXd reflection;
};

PivotedQr::PivotedQr() : implementation_(std::make_unique<Implementation>()) {}
PivotedQr::~PivotedQr() = default;
PivotedQr::PivotedQr(PivotedQr&&) noexcept = default;
PivotedQr& PivotedQr::operator=(PivotedQr&&) noexcept = default;

Eigen::MatrixXd& PivotedQr::matrix(Eigen::Index rows, Eigen::Index columns) {
  return implementation_->matrix(rows, columns);
}
void PivotedQr::factor(double threshold) { implementation_->factor(threshold); }
Eigen::Index PivotedQr::rank() const { return implementation_->now->factors.rank(); }
int PivotedQr::column(Eigen::Index k) const {
  return implementation_->now->factors.colsPermutation().indices()[k];
}

void PivotedQr::complement(Eigen::MatrixXd* basis) {
  Implementation& to = *implementation_;
  to.now->factors.householderQ().evalTo(to.Q, to.reflection);
  *basis = to.Q.rightCols(to.now->A.rows() - rank());
}

struct LeastNormWorkspace::Solution {
  Solution(Eigen::Index rows, Eigen::Index columns, Eigen::Index count)
      : rotated(rows, count),
        y(columns, count),
        x(columns, count),
        row(count),
        reflection(std::max(columns, count)) {}
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

Eigen::MatrixXd& LeastNorm::matrix(Eigen::Index rows, Eigen::Index columns) {
  return implementation_->matrix(rows, columns);
}
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
    return known->rotated.rows() == b.rows() && known->y.rows() == factors.cols() &&
           known->y.cols() == b.cols();
  });
  LeastNormWorkspace::Solution& to =
      found != solutions.end()
          ? **found
          : *solutions.emplace_back(
                std::make_unique<LeastNormWorkspace::Solution>(b.rows(), factors.cols(), b.cols()));
  const Eigen::Index rank = factors.rank();
  if (rank == 0) {
    to.x.setZero();
    return to.x;
  }
  to.rotated = b;
  factors.matrixQ().setLength(rank).adjoint().applyThisOnTheLeft(to.rotated, to.row);
  to.y.topRows(rank) = factors.matrixT()
                           .topLeftCorner(rank, rank)
                           .triangularView<Eigen::Upper>()
                           .solve(to.rotated.topRows(rank));
  to.y.bottomRows(factors.cols() - rank).setZero();
  undo_columns(factors, &to.reflection, &to.y, &to.x);
  return to.x;
}

Eigen::MatrixXd triangular_root(const Eigen::MatrixXd& A) {
  const Eigen::Index columns = A.cols();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::max(A.rows(), columns), columns);
  Eigen::VectorXd workspace(columns);
  rows.topRows(A.rows()) = A;
  reduce(A.rows(), &rows, &workspace);
  return rows.topRows(columns);
}

void RowRoot::start(Eigen::Index columns) {
  rows_.setZero(columns + std::max(columns, kWaiting), columns);
  workspace_.resize(columns);
  used_ = 0;
}

void RowRoot::add(const Eigen::Ref<const Eigen::VectorXd>& row) {
  if (used_ == rows_.rows()) {
    reduce(used_, &rows_, &workspace_);
    used_ = rows_.cols();
  }
  rows_.row(used_++) = row.transpose();
}

// The rows stand side by side as those of triangular_root() do, which gives the same bits.
void RowRoot::root(Eigen::MatrixXd* root) {
  const Eigen::Index columns = rows_.cols();
  reduced_.resize(rows_.size());
  Eigen::Map<Eigen::MatrixXd, Eigen::AlignedMax> rows(reduced_.data(), std::max(used_, columns),
                                                      columns);
  rows.setZero();
  rows.topRows(used_) = rows_.topRows(used_);
  reduce(used_, &rows, &workspace_);
  *root = rows.topRows(columns);
}

}  // namespace codesign
