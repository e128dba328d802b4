// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "sparse/least_squares.h"

namespace codesign {

/// A rank-revealing QR factorization A E = Q R of a sparse matrix by SuiteSparse's SPQR (multifrontal, with dense kernels; its cost grows
/// with the fill of R). A column whose remainder after projection onto the columns before it has a norm below the tolerance counts as
/// dependent (Heath's method).
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

  /// For each column of b the x that minimizes |A x - b| with zeros for the dependent columns; A.cols() x b.cols(). @throws std::bad_alloc
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign
