// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// The PID law u = p e + i s + d e', theory (C3), with the error e, its integral s and its rate e'. The gains are the derivatives of u by
/// e, s and e'.
template <class T>
struct Pid {
  T p{0.0}, i{0.0}, d{0.0};

  T output(const T& error, const T& integral, const T& error_rate) const { return p * error + i * integral + d * error_rate; }
};

/// A saturated effort and its derivative by the requested effort.
template <class T>
struct SaturatedEffort {
  T value{0.0};  ///< [unit of u]
  T slope{0.0};  ///< d value / d u, in (0, 1]
};

/// Smooth saturation of an actuator, doc/theory.md (13c): u / (1 + (u/u_max)^8)^(1/8).
/// Odd and analytic, with gain 1 up to terms of order (u/u_max)^8; its magnitude stays below u_max.
/// @param u requested effort [N m or N]. @param u_max > 0, the limit, in the same unit.
template <class T>
SaturatedEffort<T> saturate(const T& u, const T& u_max) {
  using std::sqrt;
  const auto eighth_root = [](const T& x) { return sqrt(sqrt(sqrt(x))); };
  const T x = u / u_max;
  // Above the limit the formula is written in 1/x, whose powers cannot overflow.
  const bool beyond = is_less(T(1.0), T(x * x), false);
  const T r = beyond ? T(1.0) / x : x, r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const T root = eighth_root(T(1.0) + r8), root9 = (T(1.0) + r8) * root;
  if (!beyond) return {u / root, T(1.0) / root9};
  const T sign(is_less(x, T(0.0), false) ? -1.0 : 1.0);
  return {sign * u_max / root, sign * r8 * r / root9};
}

}  // namespace codesign
