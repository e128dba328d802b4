// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SPARSE_SPARSE_QR_H_
#define MECHANISM_CODESIGN_SPARSE_SPARSE_QR_H_

#include <memory>
#include <vector>

#include "sparse/least_squares.h"

namespace codesign {

/// A rank-revealing QR factorization A E = Q R of a sparse matrix by SuiteSparse's SPQR: multifrontal, with dense kernels, so that its cost
/// grows with the fill of R. A column of which less than the tolerance is left, after the columns before it are taken off, counts as
/// dependent (Heath).
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

  /// @param tolerance the length below which what is left of a column counts as zero. @throws std::bad_alloc
  void factor(const SparseMatrix& A, double tolerance, Ordering ordering = Ordering::kFillReducing);

  /// Columns that follow from the others; ascending.
  std::vector<int> dependent() const;

  /// The x of least |A x - b| in which dependent columns have no part; one per column of b. @throws std::bad_alloc
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SPARSE_SPARSE_QR_H_
