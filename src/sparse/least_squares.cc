// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/least_squares.h"

#include <algorithm>
#include <numeric>

#include "math/dense.h"
#include "sparse/sparse_qr.h"

namespace codesign {
namespace {

constexpr Eigen::Index kDense = 256;  // columns up to which dense factorizations are faster

double largest_column(const SparseMatrix& A) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) largest = std::max(largest, A.col(k).norm());
  return largest;
}

Eigen::MatrixXd dense_columns(const SparseMatrix& A, const std::vector<int>& columns) { return Eigen::MatrixXd(columns_of(A, columns)); }

std::vector<int> ascending(std::vector<int> columns) {
  std::sort(columns.begin(), columns.end());
  return columns;
}

std::vector<int> independent_dense_columns(const SparseMatrix& A, const ColumnPreferences& preferences, double tolerance) {
  const Eigen::Index rank = pivot_columns(Eigen::MatrixXd(A), tolerance).rank;
  std::vector<int> chosen;
  for (const std::vector<int>& candidates : preferences) {
    // Choose by the remainder of the candidates after projection onto the columns chosen so far.
    const auto missing = rank - static_cast<Eigen::Index>(chosen.size());
    if (missing <= 0 || candidates.empty()) continue;
    const Eigen::MatrixXd taken = dense_columns(A, chosen);
    Eigen::MatrixXd rest = dense_columns(A, candidates);
    if (taken.cols() > 0) rest -= taken * LeastNorm(taken, tolerance).solve(rest);
    const PivotedColumns pivots = pivot_columns(rest, tolerance);
    const Eigen::Index take = std::min(missing, pivots.rank);
    for (Eigen::Index k = 0; k < take; ++k)
      chosen.push_back(candidates[static_cast<std::size_t>(pivots.order[static_cast<std::size_t>(k)])]);
  }
  return ascending(chosen);
}

std::vector<int> first_independent_columns(const SparseMatrix& A, const ColumnPreferences& preferences, double tolerance) {
  std::vector<int> order;
  for (const std::vector<int>& candidates : preferences) order.insert(order.end(), candidates.begin(), candidates.end());
  SparseQr qr;
  qr.factor(columns_of(A, order), tolerance * largest_column(A), SparseQr::Ordering::kNatural);
  const std::vector<int> dependent = qr.dependent();
  std::vector<int> chosen;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (!std::binary_search(dependent.begin(), dependent.end(), static_cast<int>(k))) chosen.push_back(order[k]);
  return ascending(chosen);
}

}  // namespace

struct LeastSquares::Implementation {
  bool dense = true;
  Eigen::Index columns = 0;
  LeastNorm dense_factors;
  SparseQr sparse_factors;
};

LeastSquares::LeastSquares() : implementation_(std::make_unique<Implementation>()) {}
LeastSquares::~LeastSquares() = default;
LeastSquares::LeastSquares(LeastSquares&&) noexcept = default;
LeastSquares& LeastSquares::operator=(LeastSquares&&) noexcept = default;

void LeastSquares::factor(const SparseMatrix& A, double tolerance) {
  implementation_->columns = A.cols();
  implementation_->dense = A.cols() <= kDense;
  if (A.rows() == 0 || A.cols() == 0) return;
  if (implementation_->dense) {
    implementation_->dense_factors = LeastNorm(Eigen::MatrixXd(A), tolerance);
    return;
  }
  implementation_->sparse_factors.factor(A, tolerance * largest_column(A));
}

Eigen::MatrixXd LeastSquares::solve(const Eigen::MatrixXd& b) const {
  if (b.rows() == 0 || implementation_->columns == 0) return Eigen::MatrixXd::Zero(implementation_->columns, b.cols());
  if (implementation_->dense) return implementation_->dense_factors.solve(b);
  return implementation_->sparse_factors.solve(b);
}

std::vector<int> independent_columns(const SparseMatrix& A, const ColumnPreferences& preferences, double tolerance) {
  if (A.rows() == 0 || A.cols() == 0) return {};
  return A.cols() <= kDense ? independent_dense_columns(A, preferences, tolerance) : first_independent_columns(A, preferences, tolerance);
}

std::vector<int> dependent_columns(const SparseMatrix& A, double tolerance) {
  std::vector<int> dependent;
  if (A.cols() == 0) return dependent;
  if (A.rows() == 0) {
    dependent.resize(static_cast<std::size_t>(A.cols()));
    std::iota(dependent.begin(), dependent.end(), 0);
  } else if (A.cols() <= 2 * kDense) {
    const PivotedColumns pivots = pivot_columns(Eigen::MatrixXd(A), tolerance);
    const auto zero =
        std::find_if(pivots.diagonal.begin(), pivots.diagonal.end(), [tolerance](double pivot) { return !(pivot > tolerance); });
    dependent.assign(pivots.order.begin() + (zero - pivots.diagonal.begin()), pivots.order.end());
  } else {
    SparseQr qr;
    qr.factor(A, tolerance);
    return qr.dependent();
  }
  return ascending(dependent);
}

SparseMatrix columns_of(const SparseMatrix& A, const std::vector<int>& columns) {
  SparseMatrix result(A.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.col(static_cast<Eigen::Index>(k)) = A.col(columns[k]);
  result.makeCompressed();
  return result;
}

}  // namespace codesign
