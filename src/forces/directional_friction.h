// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/friction_numbers.h"

namespace codesign {

// Friction whose numbers differ with the sign of the velocity; doc/theory.md (48). Analytic, and dissipative like each of the two laws:
// both oppose the motion, and each counts with a share between 0 and 1.

/// The share of the forward numbers, w(v) = (1 + tanh(4 v / v_t)) / 2.
/// @param v sliding velocity with sign [m/s]. @param v_t transition velocity, > 0 [m/s].
template <class T>
T forward_share(const T& v, const T& v_t) {
  using std::tanh;
  return T(0.5) * (T(1.0) + tanh(T(4.0) * v / v_t));
}

/// The coefficient with other numbers against the axis: w S_forward + (1 - w) S_backward.
/// @param S the coefficient as a function of v, mu_s, mu_d and v_t; linear in mu_s and mu_d.
template <class T, class Curve>
T directional_friction(const Curve& S, const T& v, const FrictionNumbers<T>& c) {
  const T back = S(v, c.mu_static_backward, c.mu_dynamic_backward, c.transition_velocity);
  const T more = S(v, T(c.mu_static - c.mu_static_backward), T(c.mu_dynamic - c.mu_dynamic_backward), c.transition_velocity);
  return back + forward_share<T>(v, c.transition_velocity) * more;
}

/// The viscous load c(v) rate [N or N m], c = w c_forward + (1 - w) c_backward.
/// @param radius sliding velocity per rate, v = radius rate: 1 for a slide [-], r_e for a turn [m].
template <class T>
T directional_viscous(const T& rate, const T& radius, const FrictionNumbers<T>& c) {
  const T w = forward_share<T>(T(radius * rate), c.transition_velocity);
  return (c.viscous_backward + w * (c.viscous - c.viscous_backward)) * rate;
}

}  // namespace codesign
