// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/control_law.h"
#include "math/scalar.h"

namespace codesign {

/// x within its bounds, as a program on a robot clamps it. Piecewise differentiable: at a bound
/// itself the derivative has the value inside.
template <class T>
T clamp(const T& x, const Bounds<T>& bounds) {
  if (is_less(bounds.upper, x, false)) return bounds.upper;
  if (is_less(x, bounds.lower, false)) return bounds.lower;
  return x;
}

/// Clamping of a continuous integral, theory (50): with the bound on the side of i s, y = |i| s /
/// bound and d = bound / (100 s |i|),
///   s' = e - y^8 (e + sgn(y) (e^2 + d^2)^(1/2)) / 2,
/// which is e if s moves towards zero, and e (1 - y^8) if it moves towards the bound, except for
/// errors as small as d. The integral term i s stays within its bounds and leaves a bound at once
/// when e changes its sign. Smooth: a kink at e = 0 would be a jump in the sensitivities' rates.
/// @param bounds lower < 0 < upper [unit of the output].
template <class T>
T clamped_integral_rate(const T& e, const T& s, const T& i, const Bounds<T>& bounds) {
  using std::sqrt;
  constexpr double kRate = 0.01;   // [1/s]: d would take 100 s from zero to the bound
  constexpr double kTiny = 1e-30;  // keeps the root at y = 0 differentiable
  const T gain = is_less(i, T(0.0), false) ? T(-i) : i;
  if (!is_less(T(0.0), gain, true)) return e;
  const T per_bound = gain / bounds.beside(T(i * s)), y = per_bound * s, d = T(kRate) / per_bound;
  const T y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y8 = y4 * y4;
  const T size = sqrt(y2 + T(kTiny)), outward = sqrt(e * e + d * d);
  return e - T(0.5) * (y8 * e + y6 * y * size * outward);
}

/// Back-calculation, theory (50a): s' = e - (v - u) / (T_t i), with the output u within its limit
/// and v before it. This is what is taken off, zero where T_t i is.
/// @param beyond v - u. @param tracking T_t i, tracking time times gain.
template <class T>
T tracked(const T& beyond, const T& tracking) {
  return is_less(T(0.0), T(tracking * tracking), true) ? T(beyond / tracking) : T(0.0);
}

/// Conditional integration, theory (50b): s' = e within the limit and where the error leads back;
/// beyond it s' falls to zero within a hundredth of the limit's range. Without this band the motion
/// would slide along the limit.
/// @param v the output before its limit.
template <class T>
T conditional_integral_rate(const T& e, const T& i, const T& v, const Bounds<T>& limit) {
  constexpr double kBand = 0.01;
  const T band = T(kBand) * (limit.upper - limit.lower);
  const bool is_negative = is_less(i, T(0.0), false);
  const auto fading = [&](const T& beyond, bool leads_out_if_positive) {
    name_part(v, kErrorAtLimit);
    const bool is_positive = is_below_kink(T(0.0), e, leads_out_if_positive);
    if (is_positive != leads_out_if_positive) return e;
    if (is_below_kink(band, beyond, true)) return T(0.0);
    return T(e * (T(1.0) - beyond / band));
  };
  name_part(v, kUpperLimit);
  if (is_below_kink(limit.upper, v, false)) return fading(T(v - limit.upper), !is_negative);
  name_part(v, kLowerLimit);
  if (is_below_kink(v, limit.lower, false)) return fading(T(limit.lower - v), is_negative);
  return e;
}

}  // namespace codesign
