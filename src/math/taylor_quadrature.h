// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "math/taylor.h"

namespace codesign {

/// The integral over a panel of width h between two instants, from the Taylor polynomials there:
/// h (a_0 + b_0)/2 + 3 h^2 (a_1 - b_1)/28 + h^3 (a_2 + b_2)/42 + h^4 (a_3 - b_3)/280, exact for
/// polynomials to the seventh degree (Obreschkoff, Neue Quadraturformeln, 1940).
template <class T>
T panel_integral(const Taylor<T>& from, const Taylor<T>& to, double h) {
  const T fourth = (from.c[3] - to.c[3]) * (h / 280.0);
  const T third = ((from.c[2] + to.c[2]) * (1.0 / 42.0) + fourth) * h;
  const T second = ((from.c[1] - to.c[1]) * (3.0 / 28.0) + third) * h;
  return ((from.c[0] + to.c[0]) * 0.5 + second) * h;
}

/// The change of a function over a panel of width h, from its derivatives at the two instants:
/// exact for polynomials to the sixth degree (the same formulas).
inline double panel_change(const Taylor<double>& from, const Taylor<double>& to, double h) {
  return h * (0.5 * (from.c[1] + to.c[1]) +
              h * (0.2 * (from.c[2] - to.c[2]) + h * 0.05 * (from.c[3] + to.c[3])));
}

/// The panels of an integral from 0 to `duration`: their ends, ascending, such that halving a panel
/// changes its integral by rounding alone. Where the function or its rate jumps, panels are halved
/// until they are too narrow to matter, also for the derivative of the integral by the instant of
/// the jump.
/// @param series t -> Taylor<double>
template <class Series>
std::vector<double> integration_panels(const Series& series, double duration) {
  constexpr double kRounding = 2e-15, kChange = 1e-14, kNarrowest = 1e-14;  // relative
  constexpr int kFirst = 16;
  constexpr std::size_t kMost = 100000;
  double largest = 0.0;
  for (int k = 0; k <= kFirst; ++k)
    largest = std::max(largest, std::abs(series(duration * k / kFirst).c[0]));
  std::vector<double> ends{0.0}, open;
  for (int k = kFirst; k > 0; --k) open.push_back(duration * k / kFirst);
  Taylor<double> from = series(0.0);
  while (!open.empty()) {
    const double begin = ends.back(), end = open.back(), h = 0.5 * (end - begin);
    const Taylor<double> half = series(begin + h), to = series(end);
    largest = std::max(largest, std::abs(half.c[0]));
    const double whole = panel_integral(from, to, 2.0 * h),
                 parts = panel_integral(from, half, h) + panel_integral(half, to, h);
    const double surprise = to.c[0] - from.c[0] - panel_change(from, to, 2.0 * h);
    const bool is_enough = !(std::abs(whole - parts) > kRounding * largest * duration) &&
                           !(std::abs(surprise) > kChange * largest);
    if (!is_enough && h > kNarrowest * duration && ends.size() < kMost) {
      open.push_back(begin + h);
      continue;
    }
    ends.push_back(end);
    open.pop_back();
    from = to;
  }
  return ends;
}

/// Where the function jumps: an end of a narrow panel across which its value changes.
template <class Series>
std::optional<double> find_jump(const Series& series, double duration) {
  constexpr double kNarrow = 1e-11, kChange = 1e-6;  // relative
  const std::vector<double> ends = integration_panels(series, duration);
  double largest = 0.0;
  for (const double end : ends) largest = std::max(largest, std::abs(series(end).c[0]));
  for (std::size_t k = 1; k < ends.size(); ++k)
    if (ends[k] - ends[k - 1] < kNarrow * duration &&
        std::abs(series(ends[k]).c[0] - series(ends[k - 1]).c[0]) > kChange * largest)
      return ends[k];
  return std::nullopt;
}

}  // namespace codesign
