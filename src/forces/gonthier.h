// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_GONTHIER_H_
#define MECHANISM_CODESIGN_FORCES_GONTHIER_H_

#include <cmath>

#include "forces/bristle.h"
#include "math/elementary.h"
#include "math/euler_parameters.h"
#include "math/tanh_ratio.h"
#include "mechanism/constants.h"

namespace codesign {

/// The factor d in dir(u) = d u, as a function of u.u, with its derivative; doc/theory.md (13e). d = 1/|u| for |u| >= v_e; below, the
/// parabola (3 - u.u/v_e^2)/(2 v_e), which is finite at rest and continues it with the same slope.
/// @param square u.u [m^2/s^2]. @param v_e [m/s]. @return [s/m], [s^3/m^3]
template <class T>
ValueAndSlope<T> direction_per_speed(const T& square, const T& v_e) {
  using std::sqrt;
  if (is_less(square, T(v_e * v_e), false)) {
    const T cubed = T(0.5) / (v_e * v_e * v_e);
    return {T(1.5) / v_e - square * cubed, -cubed};
  }
  const T inverse = T(1.0) / sqrt(square);
  return {inverse, T(-0.5) * inverse / square};
}

/// A vector limited in length, with its derivatives by the vector and the limit; see cut_off().
template <class T>
struct CutVector {
  Vector3<T> value = Vector3<T>::Zero();
  Matrix3<T> by_x = Matrix3<T>::Identity();
  Vector3<T> by_limit = Vector3<T>::Zero();
};

/// x if |x| <= limit, else limit x/|x|; doc/theory.md (13e).
template <class T>
CutVector<T> cut_off(const Vector3<T>& x, const T& limit) {
  using std::sqrt;
  const T square = dot(x, x);
  CutVector<T> cut;
  cut.value = x;
  if (!is_less(T(limit * limit), square, false)) return cut;
  const T inverse = T(1.0) / sqrt(square);
  cut.by_limit = inverse * x;
  cut.value = limit * cut.by_limit;
  cut.by_x = (limit * inverse) * (Matrix3<T>::Identity() - cut.by_limit * cut.by_limit.transpose());
  return cut;
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
  const Vector3<T> s_u = (T(-2.0) * v2 * s) * u;
  const ValueAndSlope<T> d = direction_per_speed<T>(square, T(T(kDirectionVelocity) * c.transition_velocity));
  const Vector3<T> sliding = (c.mu_dynamic * d.value) * u, resting = state.zeta + c.bristle_damping * u;
  const Matrix3<T> I = Matrix3<T>::Identity();
  const Matrix3<T> sliding_u = (c.mu_dynamic * d.value) * I + (T(2.0) * c.mu_dynamic * d.slope) * (u * u.transpose());

  Bristle<T> b;
  b.rate = (c.bristle_stiffness * s) * u + (left * bristle_rate) * (sliding - state.zeta);
  b.rate_u = (c.bristle_stiffness * s) * I + (left * bristle_rate) * sliding_u +
             (c.bristle_stiffness * u - bristle_rate * (sliding - state.zeta)) * s_u.transpose();
  b.rate_zeta = (-left * bristle_rate) * I;

  const T rise = c.mu_static - c.mu_dynamic;
  const Vector3<T> f = s * resting + left * sliding;
  const Matrix3<T> f_u = (resting - sliding) * s_u.transpose() + (s * c.bristle_damping) * I + left * sliding_u;
  const CutVector<T> cut = cut_off<T>(f, T(c.mu_dynamic + rise * state.dwell));
  b.mu = cut.value;
  b.mu_u = cut.by_x * f_u;
  b.mu_zeta = s * cut.by_x;
  b.mu_dwell = rise * cut.by_limit;

  const T pace = is_less(s, state.dwell, true) ? bristle_rate : T(T(1.0) / c.dwell_time);
  b.dwell_rate = pace * (s - state.dwell);
  b.dwell_u = pace * s_u;
  b.dwell_dwell = -pace;
  return b;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_GONTHIER_H_
