// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CLAMP_H_
#define MECHANISM_CODESIGN_CONTROL_CLAMP_H_

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

/// The rate of an integral that stops at its bounds, with its derivatives.
template <class T>
struct IntegralRate {
  T value{0.0};        ///< [unit of e]
  T by_error{0.0};     ///< d value / d e [-]
  T by_integral{0.0};  ///< d value / d s [1/s]
};

/// Anti-windup of a continuous integral, theory (50): with y = |i| s / bound and d = bound / (100 s |i|),
///   s' = e - y^8 (e + sgn(y) (e^2 + d^2)^(1/2)) / 2,
/// which is e if s moves towards zero, and e (1 - y^8) if it moves towards the bound, except for errors as small as d. The integral term i
/// s stays within -bound to bound and leaves the bound at once when e changes its sign. Smooth: a kink at e = 0 would be a jump in the
/// sensitivities' rates.
/// @param bound positive [unit of the output].
template <class T>
IntegralRate<T> clamped_integral_rate(const T& e, const T& s, const T& i, const T& bound) {
  using std::sqrt;
  constexpr double kRate = 0.01;   // [1/s]: d would take 100 s from zero to the bound
  constexpr double kTiny = 1e-30;  // keeps the root at y = 0 differentiable
  const T gain = is_less(i, T(0.0), false) ? T(-i) : i;
  if (!is_less(T(0.0), gain, true)) return {e, T(1.0), T(0.0)};
  const T by_s = gain / bound, y = by_s * s, d = T(kRate) / by_s;
  const T y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y8 = y4 * y4;
  const T size = sqrt(y2 + T(kTiny)), outward = sqrt(e * e + d * d);
  // y^7 |y| and its derivative.
  const T odd = y6 * y * size, odd_y = T(7.0) * y6 * size + y8 / size;
  return {e - T(0.5) * (y8 * e + odd * outward), T(1.0) - T(0.5) * (y8 + odd * e / outward),
          T(-0.5) * by_s * (T(8.0) * y6 * y * e + odd_y * outward)};
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CLAMP_H_
