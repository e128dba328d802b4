// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/euler_parameters.h"

namespace codesign {

/// The force of a spring-damper.
template <class T>
struct SpringForce {
  T length{0.0};                         ///< l [m]
  T tension{0.0};                        ///< k (l - l_0) + c l', positive if it pulls [N]
  Vector3<T> pull = Vector3<T>::Zero();  ///< tension d/l, the force on the first point; -pull acts on the second [N]
};

/// delta of theory (13b) [m]: far below the length of any spring, it keeps the direction finite where the points meet.
constexpr double kSpringSmoothing = 1e-9;

/// Linear spring and damper along the line between two points, doc/theory.md (13b): l = sqrt(d.d + delta^2),
/// pull = (k (l - l_0) + c l') d/l. Analytic everywhere; where the points meet the pull is zero for any free length.
/// @param d from the first point to the second [m], @param rate its time derivative [m/s],
/// @param stiffness k [N/m], @param damping c [N s/m], @param free_length l_0 [m].
template <class T>
SpringForce<T> spring_damper(const Vector3<T>& d, const Vector3<T>& rate, const T& stiffness, const T& damping, const T& free_length) {
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
