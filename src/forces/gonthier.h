// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/bristle.h"
#include "forces/friction_numbers.h"
#include "math/elementary.h"
#include "math/euler_parameters.h"

namespace codesign {

/// The factor d in dir(u) = d u, as a function of u.u; doc/theory.md (13e). d = 1/|u| for |u| >= v_e; below, the
/// parabola (3 - u.u/v_e^2)/(2 v_e), which is finite at rest and continues it with the same slope.
/// @param square u.u [m^2/s^2]. @param v_e [m/s]. @return [s/m]
template <class T>
T direction_per_speed(const T& square, const T& v_e) {
  using std::sqrt;
  if (is_less(square, T(v_e * v_e), false)) {
    return T(1.5) / v_e - square * (T(0.5) / (v_e * v_e * v_e));
  }
  return T(1.0) / sqrt(square);
}

/// x if |x| <= limit, else limit x/|x|; doc/theory.md (13e).
template <class T>
Vector3<T> cut_off(const Vector3<T>& x, const T& limit) {
  using std::sqrt;
  const T square = dot(x, x);
  if (!is_less(T(limit * limit), square, false)) return x;
  return limit * ((T(1.0) / sqrt(square)) * x);
}

/// Friction of Gonthier, McPhee, Lange and Piedboeuf (2004) per unit of normal force, doc/theory.md (13e). A share s = exp(-u.u/v_s^2) of
/// the contact rests and is a spring and a damper (sigma_0, sigma_1); the rest slides. The largest friction grows with the dwell state s_dw
/// from mu_d to mu_s. With zeta = sigma_0 z, c = mu_d dir(u) and f = s (zeta + sigma_1 u) + (1 - s) c:
///   mu = f cut off at mu_d + (mu_s - mu_d) s_dw,   zeta' = sigma_0 s u + (1 - s) sigma_0/sigma_1 (c - zeta),
///   s_dw' = (s - s_dw)/tau with tau = tau_dw if s >= s_dw, else sigma_1/sigma_0.
/// mu and the rates are continuous; their derivatives jump where the cut begins and where tau changes.
/// @param u slip velocity [m/s]; with one slip direction only u[0] is used, the others are zero.
template <class T>
Bristle<T> gonthier(const Vector3<T>& u, const BristleState<T>& state, const FrictionConstants<T>& c) {
  using std::exp;
  constexpr double kDirectionVelocity = 0.1;  // v_e / v_s; below it the sliding share 1 - s, and so the direction, is less than 1 %
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const T s = exp(-square * v2), left = T(1.0) - s, bristle_rate = c.bristle_stiffness / c.bristle_damping;
  const T d = direction_per_speed<T>(square, T(T(kDirectionVelocity) * c.transition_velocity));
  const Vector3<T> sliding = (c.mu_dynamic * d) * u, resting = state.zeta + c.bristle_damping * u;

  Bristle<T> b;
  b.rate = (c.bristle_stiffness * s) * u + (left * bristle_rate) * (sliding - state.zeta);
  b.mu = cut_off<T>(s * resting + left * sliding, T(c.mu_dynamic + (c.mu_static - c.mu_dynamic) * state.dwell));
  const T pace = is_less(s, state.dwell, true) ? bristle_rate : T(T(1.0) / c.dwell_time);
  b.dwell_rate = pace * (s - state.dwell);
  return b;
}

}  // namespace codesign
