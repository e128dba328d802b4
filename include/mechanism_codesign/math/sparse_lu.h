// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MATH_SPARSE_LU_H_
#define MECHANISM_CODESIGN_MATH_SPARSE_LU_H_

#include <memory>
#include <vector>

namespace codesign {

/// LU factorization of square sparse matrices that share one pattern: ordered once, refactored numerically afterwards (KLU).
///
/// A refactorization reuses the pivots of the last full one; when they have become poor (reciprocal pivot growth or condition estimate), it
/// falls back to a full factorization with fresh pivoting. Not thread-safe.
class SparseLu {
 public:
  /// @param column_start, row_index compressed-column pattern of an n x n matrix; must outlive the object.
  SparseLu(int n, const std::vector<int>& column_start, const std::vector<int>& row_index);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Factors the matrix with these nonzeros. False if it is singular to working precision.
  bool factor(const double* values);

  /// Solves in place for `count` right-hand sides, stored column by column.
  void solve(double* right_hand_side, int count = 1) const;
  /// Solves with the transpose in place.
  void solve_transposed(double* right_hand_side, int count = 1) const;

  /// How often the pivots had to be chosen anew since construction.
  long full_factorizations() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MATH_SPARSE_LU_H_
