// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/formula_laws.h"

#include <cmath>
#include <limits>
#include <optional>

#include "codegen/traced.h"

namespace codesign {
namespace {

constexpr int kMostOfDesign = 64;  // the largest whole exponent of a design that is looked for
constexpr double kMostFactors = 1 << 20;  // of a literal one

Traced whole_power(const Traced& base, int exponent) {
  if (exponent < 0) return Traced(1.0) / whole_power(base, -exponent);
  Traced result(1.0), factor = base;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = result * factor;
    factor = factor * factor;
  }
  return result;
}

/// The whole number that a number of the design is, by decisions alone, so that recordings with the
/// same outcomes are the same. Empty: it is none, or too large.
std::optional<int> whole_number_of_design(const Traced& x) {
  const Traced fraction = x - round(x);
  if (is_less(Traced(0.0), fraction * fraction, false)) return {};
  int low = -kMostOfDesign, high = kMostOfDesign;
  while (low < high) {
    const int middle = low + (high - low) / 2;  // less than high
    if (is_less(x, Traced(middle + 0.5), false))
      high = middle;
    else
      low = middle + 1;
  }
  if (is_less(x, Traced(low), false) || is_less(Traced(low), x, false)) return {};
  return low;
}

/// base^exponent at a design where the exponent has the value n. What is added is zero and has the
/// derivative by the exponent: base^n log(base), for negative bases none, that is, an infinite one.
Traced whole_power_of_design(const Traced& base, const Traced& exponent, int n) {
  using Limits = std::numeric_limits<double>;
  const Traced result = whole_power(base, n), zero = exponent - Traced(n);
  if (is_less(base, Traced(0.0), false))
    return result + zero * Traced(Limits::max()) * Traced(Limits::max());
  return result + result * zero * log(base + Traced(Limits::min()));
}

}  // namespace

Traced power(const Traced& base, const Traced& exponent) {
  if (base.is_literal() && exponent.is_literal()) return std::pow(base.value(), exponent.value());
  const double n = exponent.value();
  if (exponent.is_literal()) {
    if (std::nearbyint(n) == n && std::abs(n) <= kMostFactors)
      return whole_power(base, static_cast<int>(n));
  } else if (!exponent.recording()->node(exponent.node()).varies) {
    if (const std::optional<int> whole = whole_number_of_design(exponent))
      return whole_power_of_design(base, exponent, *whole);
  }
  return exp(exponent * log(base));
}

}  // namespace codesign
