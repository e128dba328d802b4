// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SPARSE_PIVOTS_H_
#define MECHANISM_CODESIGN_SPARSE_PIVOTS_H_

#include <cstdint>
#include <optional>
#include <vector>

#include "sparse/lu_schedule.h"

namespace codesign {

/// Which row and column of a matrix each pivot takes, and the scales of the rows in pivot order.
struct Pivots {
  std::vector<int> row_of, column_of;
  std::vector<double> row_scale;
};

/// The patterns of L and U with their fill for these pivots, by elimination without numbers.
/// @param column_start, row_index pattern of the matrix, by columns.
LuPattern eliminate_pattern(const Pivots& pivots, const std::vector<int>& column_start, const std::vector<int>& row_index);

/// How many products the elimination takes.
std::int64_t count_products(const LuPattern& pattern);

/// The cheapest of what KLU proposes with several orderings for a matrix with these values; nothing if it is singular.
std::optional<LuPattern> choose_pivots(const std::vector<int>& column_start, const std::vector<int>& row_index, const double* values);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SPARSE_PIVOTS_H_
