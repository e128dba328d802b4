// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace codesign {

/// A derivative with an estimate of its absolute error.
struct RiddersDerivative {
  double value = 0.0;
  double error = std::numeric_limits<double>::infinity();  ///< the change by the last extrapolation; infinite if f was never finite
};

/// Derivative of f at x by central differences extrapolated to step zero (Ridders, doc/theory.md [9]). Six steps, two calls of f each.
/// @param step the first step; each further one is half as long.
template <class Function>
RiddersDerivative ridders_derivative(const Function& f, double x, double step) {
  constexpr int kLevels = 6;
  constexpr double kShrink = 2.0;
  std::array<std::array<double, kLevels>, kLevels> table{};
  RiddersDerivative best;
  double h = step;
  for (std::size_t i = 0; i < kLevels; ++i, h /= kShrink) {
    table[0][i] = (f(x + h) - f(x - h)) / (2.0 * h);
    double factor = kShrink * kShrink;
    for (std::size_t j = 1; j <= i; ++j, factor *= kShrink * kShrink) {
      table[j][i] = (factor * table[j - 1][i] - table[j - 1][i - 1]) / (factor - 1.0);
      const double error = std::max(std::abs(table[j][i] - table[j - 1][i]), std::abs(table[j][i] - table[j - 1][i - 1]));
      if (error <= best.error) best = {table[j][i], error};
    }
  }
  return best;
}

}  // namespace codesign
