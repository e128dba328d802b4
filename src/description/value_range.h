// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace codesign {

enum class FunctionKind : unsigned char;

/// Numbers from `lower` to `upper`, both included; by default all. As the scalar of expressions
/// (description/formula.h) it computes by interval arithmetic (Moore 1966): each operation gives
/// the range of its results over all values of its operands, as if these were independent. So the
/// range of an expression contains all its values, and more where a variable appears twice. An
/// operation that may have no result, such as a quotient by a range with zero, gives all numbers.
/// Rounding is not taken into account.
struct ValueRange {
  double lower = -std::numeric_limits<double>::infinity(),
         upper = std::numeric_limits<double>::infinity();

  ValueRange() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): numbers mix with ranges in every formula.
  ValueRange(double number) : lower(number), upper(number) {}
  ValueRange(double low, double high) : lower(low), upper(high) {}

  bool is_number() const { return lower == upper; }
  bool holds(double x) const { return lower <= x && x <= upper; }
};

inline bool is_zero(const ValueRange& x) { return x.lower == 0.0 && x.upper == 0.0; }
ValueRange operator-(const ValueRange& x);
ValueRange operator+(const ValueRange& x, const ValueRange& y);
ValueRange operator-(const ValueRange& x, const ValueRange& y);
ValueRange product(const ValueRange& x, const ValueRange& y);
ValueRange quotient(const ValueRange& x, const ValueRange& y);

/// The smallest range with all numbers of both.
ValueRange hull(const ValueRange& x, const ValueRange& y);

/// Base to the power of the exponent. A negative base has a power with one whole exponent only.
ValueRange power(const ValueRange& base, const ValueRange& exponent);

/// A function of expressions of so many arguments.
ValueRange formula_function(FunctionKind kind, const ValueRange* z, int count);

/// Whether x < y: 1 if for all numbers of both, 0 if for none, else from 0 to 1.
ValueRange less(const ValueRange& x, const ValueRange& y);
/// The same of x = y.
ValueRange equal(const ValueRange& x, const ValueRange& y);

}  // namespace codesign
