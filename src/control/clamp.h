// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CONTROL_CLAMP_H_
#define MECHANISM_CODESIGN_CONTROL_CLAMP_H_

#include "math/scalar.h"

namespace codesign {

/// x within -bound to bound, as a program on a robot does it. Piecewise differentiable: on the bound itself the derivative is that inside.
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

/// Anti-windup of a continuous integral, theory (50): s' = e (1 - x^8) with x = i s / bound where e drives s away from zero, else s' = e.
/// The integral term i s stays within -bound to bound and leaves the bound at once when e changes its sign. Where e = 0 the derivatives are
/// those of the second case.
/// @param bound positive [unit of the output].
template <class T>
IntegralRate<T> clamped_integral_rate(const T& e, const T& s, const T& i, const T& bound) {
  if (!is_less(T(0.0), T(e * s), true)) return {e, T(1.0), T(0.0)};
  const T by_s = i / bound, x = by_s * s, x2 = x * x, x4 = x2 * x2, left = T(1.0) - x4 * x4;
  return {e * left, left, T(-8.0) * e * x4 * x2 * x * by_s};
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_CONTROL_CLAMP_H_
