// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// x within -bound to bound, as a program on a robot clamps it. Piecewise differentiable: at the bound itself the derivative has the value
/// inside.
/// @param bound not negative, in the unit of x.
template <class T>
T clamp(const T& x, const T& bound) {
  if (is_less(bound, x, false)) return bound;
  if (is_less(x, T(-bound), false)) return -bound;
  return x;
}

/// Anti-windup of a continuous integral, theory (50): with y = |i| s / bound and d = bound / (100 s |i|),
///   s' = e - y^8 (e + sgn(y) (e^2 + d^2)^(1/2)) / 2,
/// which is e if s moves towards zero, and e (1 - y^8) if it moves towards the bound, except for errors as small as d. The integral term i
/// s stays within -bound to bound and leaves the bound at once when e changes its sign. Smooth: a kink at e = 0 would be a jump in the
/// sensitivities' rates.
/// @param bound positive [unit of the output].
template <class T>
T clamped_integral_rate(const T& e, const T& s, const T& i, const T& bound) {
  using std::sqrt;
  constexpr double kRate = 0.01;   // [1/s]: d would take 100 s from zero to the bound
  constexpr double kTiny = 1e-30;  // keeps the root at y = 0 differentiable
  const T gain = is_less(i, T(0.0), false) ? T(-i) : i;
  if (!is_less(T(0.0), gain, true)) return e;
  const T per_bound = gain / bound, y = per_bound * s, d = T(kRate) / per_bound;
  const T y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y8 = y4 * y4;
  const T size = sqrt(y2 + T(kTiny)), outward = sqrt(e * e + d * d);
  return e - T(0.5) * (y8 * e + y6 * y * size * outward);
}

}  // namespace codesign
