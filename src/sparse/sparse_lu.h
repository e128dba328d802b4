// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "math/arrays.h"

namespace codesign {

/// LU factorization of square sparse matrices that share one pattern. Pivots are chosen once
/// (choose_pivots()); later matrices are refactored with the same pivots (LuSchedule).
///
/// If an entry of L exceeds 1e6 or the ratio of the smallest to the largest pivot falls to 1e-17,
/// up to three earlier choices of pivots are tried, then pivots are chosen again. A matrix is
/// singular to working precision if a pivot is what rounding leaves of its terms: not where it is
/// only small, as those of light bodies beside constraints, whose rows have other units. For such
/// matrices the ratio may fall to a millionth of that of the choice. Not thread-safe.
class SparseLu {
 public:
  /// @param column_start, row_index compressed-column pattern of an n x n matrix.
  SparseLu(const std::vector<int>& column_start, const std::vector<int>& row_index);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// Factors the matrix with these nonzeros, in the order of row_index. False if it is singular to
  /// working precision.
  bool factor(In<double> values);

  /// Makes later factorizations independent of all matrices since keep_pivots(): the next one
  /// begins with the pivots that keep_pivots() kept, or chooses pivots again if keep_pivots() was
  /// never called. To be called at the beginning of a run, so that its last bits do not depend on
  /// earlier runs.
  void reset_pivots();
  /// Keeps the present pivots as the pivots with which reset_pivots() begins again.
  void keep_pivots();
  /// Takes the kept pivots of another factorization of the same pattern as its own, unless it
  /// has some already or `other` has none.
  void keep_pivots_of(const SparseLu& other);

  /// Solves A x = b in place, n numbers.
  void solve(Out<double> x) const { solve_rows<1>(x); }
  /// Solves in place for N right-hand sides, stored row by row: x[N row + k]. N is 1, 4 or 8.
  template <int N>
  void solve_rows(Out<double> x) const;
  /// Solves A^T x = b likewise.
  template <int N>
  void solve_transposed_rows(Out<double> x) const;

  /// How often pivots were chosen since construction.
  std::int64_t full_factorizations() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace codesign
