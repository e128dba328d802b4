// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/friction_numbers.h"
#include "math/scalar.h"

namespace codesign {

/// Friction coefficient of Brown and McPhee (2016) without the viscous term, the bracket in the
/// paper's (1); doc/theory.md (10):
///   S(v) = mu_d tanh(4 v / v_t) + (mu_s - mu_d) (v / v_t) / ((v / (2 v_t))^2 + 3/4)^2.
/// @param v sliding velocity with sign [m/s]. @param v_t transition velocity, > 0 [m/s].
template <class T>
T brown_mcphee(const T& v, const T& mu_static, const T& mu_dynamic, const T& v_t) {
  using std::tanh;
  const T u = v / v_t;
  const T d = 0.25 * u * u + 0.75;
  return mu_dynamic * tanh(4.0 * u) + (mu_static - mu_dynamic) / (d * d) * u;
}

/// Stribeck's curve as it is identified, per unit of normal force; doc/theory.md (10a):
///   S(v) = (mu_d + (mu_s - mu_d) exp(-v^2/v_s^2)) tanh(4 v / v_t).
/// Linear in mu_s and mu_d.
/// @param v sliding velocity with sign [m/s]; direct friction [m/s or rad/s], mu_s, mu_d [N or N
/// m].
template <class T>
T stribeck(const T& v, const T& mu_static, const T& mu_dynamic, const FrictionNumbers<T>& c) {
  using std::exp;
  using std::tanh;
  const T w = v / c.stribeck_velocity;
  return (mu_dynamic + (mu_static - mu_dynamic) * exp(-(w * w))) *
         tanh(4.0 * (v / c.transition_velocity));
}

/// The factor by which the viscous load c rate becomes c |rate|^a sgn(rate), smooth at rest;
/// doc/theory.md (10a): (rate^2 + w^2)^((a - 1)/2).
/// @param rate [rad/s or m/s], @param w transition velocity as a rate, > 0, @param a exponent [-].
template <class T>
T viscous_power(const T& rate, const T& w, const T& a) {
  using std::exp;
  using std::log;
  return exp(0.5 * (a - 1.0) * log(rate * rate + w * w));
}

// Friction whose numbers differ with the sign of the velocity; doc/theory.md (48). Analytic, and
// dissipative like each of the two laws: both oppose the motion, and each counts with a share
// between 0 and 1.

/// The share of the forward numbers, w(v) = (1 + tanh(4 v / v_t)) / 2.
/// @param v sliding velocity with sign [m/s]. @param v_t transition velocity, > 0 [m/s].
template <class T>
T forward_share(const T& v, const T& v_t) {
  using std::tanh;
  return T(0.5) * (T(1.0) + tanh(T(4.0) * v / v_t));
}

/// The coefficient with other numbers against the axis: w S_forward + (1 - w) S_backward.
/// @param S the coefficient as a function of v, mu_s and mu_d; linear in mu_s and mu_d.
template <class T, class Curve>
T directional_friction(const Curve& S, const T& v, const FrictionNumbers<T>& c) {
  const T back = S(v, c.mu_static_backward, c.mu_dynamic_backward);
  const T more =
      S(v, T(c.mu_static - c.mu_static_backward), T(c.mu_dynamic - c.mu_dynamic_backward));
  return back + forward_share<T>(v, c.transition_velocity) * more;
}

/// The viscous load c(v) rate [N or N m], c = w c_forward + (1 - w) c_backward.
/// @param radius sliding velocity per rate, v = radius rate: 1 for a slide [-], r_e for a turn [m].
template <class T>
T directional_viscous(const T& rate, const T& radius, const FrictionNumbers<T>& c) {
  const T w = forward_share<T>(T(radius * rate), c.transition_velocity);
  return (c.viscous_backward + w * (c.viscous - c.viscous_backward)) * rate;
}

/// Brown and McPhee's friction coefficient divided by the sliding speed s, as a function of s^2;
/// analytic also at rest; doc/theory.md (13a).
/// @param square s^2 [m^2/s^2], @param v_t transition velocity [m/s].
/// @return S(s)/s [s/m].
template <class T>
T friction_per_speed(const T& square, const T& mu_static, const T& mu_dynamic, const T& v_t) {
  const T scale = T(1.0) / (v_t * v_t), w = square * scale;
  const T h = tanh_ratio<T>(T(16.0) * w);  // tanh(4u)/(4u), u = sqrt w
  const T d = T(0.25) * w + T(0.75);
  return (T(4.0) * mu_dynamic * h + (mu_static - mu_dynamic) / (d * d)) / v_t;
}

/// The load L = S(|u|) N u/|u| [N] of a contact that slips in D directions, with the same
/// coefficient in all of them, theory (13a). It opposes the slip, with the power -L . u; zero at
/// rest.
/// @param u slip velocity [m/s], @param normal N [N], @param per_speed S(|u|)/|u| [s/m] as a
/// function of u.u.
template <class T, int D, class PerSpeed>
Eigen::Matrix<T, D, 1> isotropic_friction(const Eigen::Matrix<T, D, 1>& u, const T& normal,
                                          const PerSpeed& per_speed) {
  T square(0.0);
  for (int k = 0; k < D; ++k) square += u[k] * u[k];
  const T sigma = per_speed(square);
  return normal * (sigma * u);
}

/// The length of a vector, for signals. At zero, where it has no derivative, the derivative is set
/// to zero.
template <class T, int D>
T length_of(const Eigen::Matrix<T, D, 1>& u) {
  using std::sqrt;
  T square(0.0);
  for (int k = 0; k < D; ++k) square += u[k] * u[k];
  return is_less(T(0.0), square, true) ? T(sqrt(square)) : T(0.0);
}

}  // namespace codesign
