// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "math/arrays.h"
#include "sparse/lu_schedule.h"

namespace codesign {

/// The row and column of each pivot of an n x n matrix, and the scales of the rows, all in pivot
/// order.
struct Pivots {
  std::vector<int> row_of, column_of;
  std::vector<double> row_scale;
};

/// The patterns of L and U, fill included, for these pivots, by symbolic elimination.
/// @param column_start, row_index pattern of the matrix in compressed-column form.
LuPattern eliminate_pattern(const Pivots& pivots, const std::vector<int>& column_start,
                            const std::vector<int>& row_index);

/// The number of multiplications of the elimination.
std::int64_t count_products(const LuPattern& pattern);

/// Pivots for a matrix with these values: the cheapest (count_products()) of the pivots that KLU
/// finds with several orderings. std::nullopt if KLU finds the matrix singular with every ordering.
std::optional<LuPattern> choose_pivots(const std::vector<int>& column_start,
                                       const std::vector<int>& row_index, In<double> values);

}  // namespace codesign
