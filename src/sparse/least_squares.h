// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SPARSE_LEAST_SQUARES_H_
#define MECHANISM_CODESIGN_SPARSE_LEAST_SQUARES_H_

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace codesign {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Minimizes |A x - b| for a sparse matrix of any rank. Up to 256 columns by a complete orthogonal decomposition, which gives the shortest
/// x; more by a sparse QR factorization, which gives one with as many nonzeros as the rank.
class LeastSquares {
 public:
  LeastSquares();
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;
  LeastSquares& operator=(LeastSquares&&) noexcept;

  /// @param tolerance what is smaller than this, relative to the largest column, counts as zero.
  void factor(const SparseMatrix& A, double tolerance);
  /// One x per column of b.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Columns of a matrix in the order in which they are wanted. Each list holds indices of columns.
using ColumnPreferences = std::vector<std::vector<int>>;

/// As many independent columns as the matrix has, those of an earlier list before those of a later one; ascending.
/// Up to 256 columns the best conditioned of a list are taken, of more those that come first.
/// @param tolerance as for LeastSquares.
std::vector<int> independent_columns(const SparseMatrix& A, const ColumnPreferences& preferences, double tolerance);

/// The columns that follow from the others, as few and as well chosen as a pivoted QR factorization does; ascending.
/// @param tolerance as an absolute length of what is left of a column.
std::vector<int> dependent_columns(const SparseMatrix& A, double tolerance);

/// Some columns of a matrix, in the order given.
SparseMatrix columns_of(const SparseMatrix& A, const std::vector<int>& columns);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SPARSE_LEAST_SQUARES_H_
