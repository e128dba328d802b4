// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "codegen/straight_line.h"
#include "math/arrays.h"

namespace codesign {

/// Pivots and patterns of one factorization L U = P R^-1 A Q of an n x n matrix. Row indices ascend
/// within each column of L and U.
struct LuPattern {
  std::vector<int> row_of, column_of;  ///< pivot k is in row row_of[k] and column column_of[k] of A
  std::vector<double> row_scale;       ///< the diagonal of R, in pivot order
  std::vector<std::vector<int>> U, L;  ///< per column: the rows above, the rows below the diagonal
};

/// Numerical refactorization and triangular solves for one LuPattern, from precomputed lists of
/// their operations.
///
/// All factors are in one array, row after row: the entries of L, the inverse pivot, the entries of
/// U. A triangular solve then reads the array from end to end and keeps its sums in registers. The
/// lists are compiled to machine code where that is possible; otherwise, and for transposes, loops
/// follow them.
class LuSchedule {
 public:
  /// @param column_start, row_index pattern of A in compressed-column form.
  /// @param machine_code whether to compile the lists where that is possible.
  LuSchedule(const LuPattern& pattern, const std::vector<int>& column_start,
             const std::vector<int>& row_index, bool machine_code = true);

  /// How well the pivots suit the values. Not finite if a pivot vanished.
  struct Quality {
    double growth = 0.0;       ///< largest |entry of L|
    double pivot_ratio = 0.0;  ///< smallest over largest |pivot|
  };

  /// The smallest |pivot| of the last refactor() over the largest term of the sum that it is: far
  /// above rounding unless the matrix is singular to working precision, whatever the units of its
  /// rows and columns are.
  double cancellation() const;

  /// Takes the row scales of a pattern with the same pivots, as if constructed with it. False, and
  /// nothing is changed, for other pivots.
  bool rescale(const LuPattern& pattern);
  /// Factors the matrix with these nonzeros, in the order of row_index.
  Quality refactor(In<double> values);
  /// Solves A x = b in place for N right-hand sides stored row by row: x[N row + k]. N is 1, 4
  /// or 8.
  template <int N>
  void solve(Out<double> x) const;
  /// Solves A^T x = b likewise.
  template <int N>
  void solve_transposed(Out<double> x) const;

 private:
  void lay_out(const LuPattern& pattern);
  void place_sources(const std::vector<int>& column_start, const std::vector<int>& row_index);
  void list_targets();
  std::vector<Sum> elimination_sums() const;
  std::vector<Sum> solution_sums() const;
  void eliminate(In<double> values);
  template <class BeginRow, class Target>
  void eliminate_rows(const BeginRow& begin_row, Target target);
  Quality quality() const;
  template <int N>
  void solve_by_lists(Out<double> x) const;

  std::size_t n_;
  std::vector<int> row_of_, column_of_;
  std::vector<double> inverse_scale_;
  /// per row: index of its first entry (n + 1 of them) and of its pivot
  std::vector<int> start_, diagonal_;
  std::vector<int> column_;       ///< of each entry of the factors
  std::vector<int> source_slot_;  ///< per entry of A: the entry of the factors that it initializes
  std::vector<double> source_scale_;  ///< per entry of A: 1 / scale of its row
  /// the entry that each product of the elimination is subtracted from, in order; empty if there
  /// are too many
  std::vector<int> target_;
  /// used if target_ is empty: per column, the entry of the row that is being eliminated
  std::vector<int> entry_of_;
  std::vector<int> multiplier_;  ///< the entries of L
  std::vector<double> factors_;  ///< entries of L and U, with inverse pivots
  mutable LineVector work_;

  LazyStraightLine elimination_;
  mutable LazyStraightLine solution_;
};

}  // namespace codesign
