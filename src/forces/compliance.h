// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// A ramp with a rounded corner [m or rad]: 0 for g <= 0, g - w/2 for g >= w, and w (5/2 s^4 - 3
/// s^5
/// + s^6) with s = g/w in between; three times continuously differentiable.
/// @param width w > 0.
template <class T>
T rounded_ramp(const T& g, const T& width) {
  if (!is_less(T(0.0), g, false)) return T(0.0);
  if (!is_less(g, width, true)) return g - T(0.5) * width;
  const T s = g / width, s3 = s * s * s;
  return width * s3 * s * (T(2.5) + s * (s - T(3.0)));
}

/// The slope of rounded_ramp(), 0 ... 1.
template <class T>
T rounded_ramp_slope(const T& g, const T& width) {
  if (!is_less(T(0.0), g, false)) return T(0.0);
  if (!is_less(g, width, true)) return T(1.0);
  const T s = g / width;
  return s * s * s * (T(10.0) + s * (T(6.0) * s - T(15.0)));
}

/// The integral of rounded_ramp() by g from 0 [m^2 or rad^2].
template <class T>
T rounded_ramp_integral(const T& g, const T& width) {
  if (!is_less(T(0.0), g, false)) return T(0.0);
  // At g = w it is w^2/7.
  if (!is_less(g, width, true)) return width * width / T(7.0) + T(0.5) * (g - width) * g;
  const T s = g / width, s2 = s * s;
  return width * width * s2 * s2 * s * (T(0.5) - T(0.5) * s + s2 / T(7.0));
}

/// The force of a joint's stop, doc/theory.md (13d): F = k delta(g) h(c g') [N or N m], which
/// pushes the joint back into its range; never negative.
///
/// delta(g) is rounded_ramp(). h(y) = y + sqrt(1 + y^2) is positive and makes the force larger
/// while the excess grows than while it falls.
/// @param excess g, by which the joint is beyond its limit [m or rad], @param rate g' [m/s or
/// rad/s],
/// @param stiffness k [N/m or N m/rad], @param dissipation c [s/m or s/rad], @param width w > 0 [m
/// or rad].
template <class T>
T joint_stop(const T& excess, const T& rate, const T& stiffness, const T& dissipation,
             const T& width) {
  using std::sqrt;
  if (!is_below_kink(T(0.0), excess, false)) return T(0.0);
  const T depth = rounded_ramp(excess, width);
  const T y = dissipation * rate, root = sqrt(T(1.0) + y * y);
  // h(y) = 1/(sqrt(1 + y^2) - y) avoids cancellation for negative y.
  const T growth = is_less(y, T(0.0), false) ? T(1.0) / (root - y) : y + root;
  return stiffness * depth * growth;
}

/// The elastic energy of a stop, the integral of k delta(g) by g from 0 [J].
template <class T>
T stop_energy(const T& excess, const T& stiffness, const T& width) {
  return stiffness * rounded_ramp_integral(excess, width);
}

/// The force of a spring-damper.
template <class T>
struct SpringForce {
  T length{0.0};   ///< l [m]
  T tension{0.0};  ///< k (l - l_0) + c l', positive if it pulls [N]
  /// tension d/l, the force on the first point; -pull acts on the second [N]
  Vector3<T> pull = Vector3<T>::Zero();
};

/// delta of theory (13b) [m]: far below the length of any spring, it keeps the direction finite
/// where the points meet.
constexpr double kSpringSmoothing = 1e-9;

/// Linear spring and damper along the line between two points, doc/theory.md (13b): l = sqrt(d.d +
/// delta^2), pull = (k (l - l_0) + c l') d/l. Analytic everywhere; where the points meet the pull
/// is zero for any free length.
/// @param d from the first point to the second [m], @param rate its time derivative [m/s],
/// @param stiffness k [N/m], @param damping c [N s/m], @param free_length l_0 [m].
template <class T>
SpringForce<T> spring_damper(const Vector3<T>& d, const Vector3<T>& rate, const T& stiffness,
                             const T& damping, const T& free_length) {
  using std::sqrt;
  SpringForce<T> s;
  s.length = sqrt(dot(d, d) + T(kSpringSmoothing * kSpringSmoothing));
  const Vector3<T> e = (T(1.0) / s.length) * d;
  s.tension = stiffness * (s.length - free_length) + damping * dot(e, rate);
  s.pull = s.tension * e;
  return s;
}

/// The elastic energy k (l - l_0)^2/2 [J]; parameters as for spring_damper().
template <class T>
T spring_energy(const Vector3<T>& d, const T& stiffness, const T& free_length) {
  using std::sqrt;
  const T stretch = sqrt(dot(d, d) + T(kSpringSmoothing * kSpringSmoothing)) - free_length;
  return T(0.5) * stiffness * stretch * stretch;
}

}  // namespace codesign
