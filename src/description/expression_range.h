// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "description/expression_program.h"

namespace codesign {

/// Numbers from `lower` to `upper`, both included; by default all.
struct ValueRange {
  double lower = -std::numeric_limits<double>::infinity(), upper = std::numeric_limits<double>::infinity();
};

/// A range that contains every value of an expression whose variables lie in given ranges, by interval arithmetic (Moore 1966) on sums,
/// differences, products and quotients. With any other operation the range is all numbers. Rounding is not taken into account.
/// @param variables by index.
ValueRange range_of(const ExpressionSteps& steps, In<ValueRange> variables);

}  // namespace codesign
