// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "math/dense.h"

namespace codesign {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// The memory for solutions of LeastSquares.
struct LeastSquaresWorkspace {
  LeastNormWorkspace dense;
  Eigen::MatrixXd other;  ///< a solution that is not dense, or of nothing
};

/// Minimizes |A x - b| (2-norm) for a sparse matrix of any rank. Up to 256 columns it uses a
/// complete orthogonal decomposition and returns the x of least norm; beyond that a sparse QR
/// factorization, whose x has at most as many nonzeros as the rank.
class LeastSquares {
 public:
  LeastSquares();
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;
  LeastSquares& operator=(LeastSquares&&) noexcept;

  /// @param tolerance pivots below this, relative to the largest column of A, count as zero.
  void factor(const SparseMatrix& A, double tolerance);
  /// The same for some columns of A, in the order given. Allocates nothing where the decomposition
  /// is dense and its shape was had before.
  void factor(const SparseMatrix& A, const std::vector<int>& columns, double tolerance);
  /// The solution for each column of b; A.cols() x b.cols(). After factor().
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// The same, valid until the workspace is used again. Allocates nothing on the same conditions.
  Eigen::MatrixXd& solve(const Eigen::MatrixXd& b, LeastSquaresWorkspace* workspace) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Lists of column indices in order of preference: columns of an earlier list are preferred to
/// columns of a later list.
using ColumnPreferences = std::vector<std::vector<int>>;

/// A maximal set of independent columns that prefers earlier lists; indices in ascending order.
/// Within a list, matrices of up to 256 columns yield the best conditioned columns (pivoted QR),
/// larger ones the first. Allocates nothing, up to 256 columns, for matrices of shapes that it has
/// had before.
class IndependentColumns {
 public:
  /// @param tolerance as for LeastSquares::factor(). @returns indices that are valid until the next
  /// call.
  const std::vector<int>& choose(const SparseMatrix& A, const ColumnPreferences& preferences,
                                 double tolerance);

 private:
  void choose_dense(const SparseMatrix& A, const ColumnPreferences& preferences, double tolerance);

  std::vector<int> chosen_;
  PivotedQr qr_;
  LeastNorm taken_;
  LeastNormWorkspace workspace_;
  Eigen::MatrixXd projection_;
};
/// The same, once.
std::vector<int> independent_columns(const SparseMatrix& A, const ColumnPreferences& preferences,
                                     double tolerance);

/// The columns that depend on the others according to a pivoted QR factorization (sparse beyond 512
/// columns); indices in ascending order.
/// @param tolerance a column depends on the others if the norm of its remainder is not above this
/// (absolute).
std::vector<int> dependent_columns(const SparseMatrix& A, double tolerance);

/// Some columns of a matrix, in the order given.
SparseMatrix columns_of(const SparseMatrix& A, const std::vector<int>& columns);

/// A rank-revealing QR factorization A E = Q R of a sparse matrix by SuiteSparse's SPQR
/// (multifrontal, with dense kernels; its cost grows with the fill of R). A column whose remainder
/// after projection onto the columns before it has a norm below the tolerance counts as dependent
/// (Heath's method).
class SparseQr {
 public:
  enum class Ordering {
    kFillReducing,  ///< COLAMD
    kNatural        ///< columns in the order of the matrix: the first independent ones are kept
  };

  SparseQr();
  ~SparseQr();
  SparseQr(SparseQr&&) noexcept;
  SparseQr& operator=(SparseQr&&) noexcept;

  /// @param tolerance on the norm of a column's remainder, absolute. @throws std::bad_alloc
  void factor(const SparseMatrix& A, double tolerance, Ordering ordering = Ordering::kFillReducing);

  /// Indices of the dependent columns, ascending.
  std::vector<int> dependent() const;

  /// For each column of b the x that minimizes |A x - b| with zeros for the dependent columns;
  /// A.cols() x b.cols(). @throws std::bad_alloc
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign
