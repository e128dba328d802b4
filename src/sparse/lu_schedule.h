// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SPARSE_LU_SCHEDULE_H_
#define MECHANISM_CODESIGN_SPARSE_LU_SCHEDULE_H_

#include <cstddef>
#include <vector>

#include "codegen/straight_line.h"
#include "math/line_vector.h"

namespace codesign {

/// Pivots and patterns of one factorization L U = P R^-1 A Q, columns of L and U with ascending rows.
struct LuPattern {
  std::vector<int> row_of, column_of;  ///< pivot k took row row_of[k] and column column_of[k] of A
  std::vector<double> row_scale;       ///< R, in pivot order
  std::vector<std::vector<int>> U, L;  ///< per column: rows above, rows below the diagonal
};

/// The refactorization and the triangular solves for one LuPattern, as flat lists of what to do.
///
/// All factors lie in one array, row after row: the entries of L, the inverse pivot, the entries of U. Rows, because a triangular solve
/// then reads the array from end to end and keeps its sums in registers. Where it can, the lists are compiled to machine code; otherwise,
/// and for transposes, loops follow them.
class LuSchedule {
 public:
  /// @param column_start, row_index pattern of A.
  /// @param machine_code whether to compile the lists where that is possible.
  LuSchedule(const LuPattern& pattern, const std::vector<int>& column_start, const std::vector<int>& row_index, bool machine_code = true);

  /// Largest multiplier, and smallest over largest pivot; not finite if a pivot vanished.
  struct Quality {
    double growth = 0.0, pivot_ratio = 0.0;
  };
  Quality refactor(const double* values);

  template <int N>
  void solve(double* x) const;
  template <int N>
  void solve_transposed(double* x) const;

 private:
  void lay_out(const LuPattern& pattern);
  void place_sources(const std::vector<int>& column_start, const std::vector<int>& row_index);
  void list_targets();
  std::vector<Sum> elimination_sums() const;
  std::vector<Sum> solution_sums() const;
  void eliminate(const double* values);
  template <class BeginRow, class Target>
  void eliminate_rows(const BeginRow& begin_row, Target target);
  Quality quality() const;
  template <int N>
  void solve_by_lists(double* x) const;

  std::size_t n_;
  std::vector<int> row_of_, column_of_;
  std::vector<double> inverse_scale_;
  std::vector<int> start_, diagonal_;  ///< per row: first entry, and the pivot's place; start_ has n + 1
  std::vector<int> column_;            ///< of each entry
  std::vector<int> source_slot_;       ///< where each entry of A goes
  std::vector<double> source_scale_;
  std::vector<int> target_;      ///< where each product of the elimination is subtracted, in order; empty if there are too many
  std::vector<int> entry_of_;    ///< then: where the row that is being eliminated has each column
  std::vector<int> multiplier_;  ///< places of the entries of L
  std::vector<double> factors_;  ///< of L and U, with inverse pivots
  mutable LineVector work_;

  LazyStraightLine elimination_;
  mutable LazyStraightLine solution_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SPARSE_LU_SCHEDULE_H_
