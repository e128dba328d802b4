// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FORCES_LUGRE_H_
#define MECHANISM_CODESIGN_FORCES_LUGRE_H_

#include <cmath>

#include "forces/bristle.h"
#include "math/euler_parameters.h"
#include "mechanism/constants.h"

namespace codesign {

/// LuGre friction of Canudas de Wit, Olsson, Astrom and Lischinsky (1995) per unit of normal force, equal in all directions; doc/theory.md
/// (13f):
///   zeta' = sigma_0 (u - |u|/g zeta),   g = mu_d + (mu_s - mu_d) exp(-u.u/v_s^2),   mu = zeta + sigma_1/sigma_0 zeta',
/// with zeta = sigma_0 z. In steady sliding |mu| = g. At rest, where |u| has no derivative, its derivative is set to zero. g must not
/// vanish.
/// @param u slip velocity [m/s]; with one slip direction only u[0] is used, the others are zero. The dwell state is not used.
template <class T>
Bristle<T> lugre(const Vector3<T>& u, const BristleState<T>& state, const FrictionConstants<T>& c) {
  using std::exp;
  using std::sqrt;
  const T square = dot(u, u), v2 = T(1.0) / (c.transition_velocity * c.transition_velocity);
  const bool moving = is_less(T(0.0), square, true);
  const T speed = moving ? T(sqrt(square)) : T(0.0);
  const T rise = (c.mu_static - c.mu_dynamic) * exp(-square * v2), g = c.mu_dynamic + rise;
  const T turnover = speed / g;  // |u|/g, the rate of bristle replacement divided by sigma_0 [m/s]
  const T by_square = moving ? T(T(0.5) / speed / g + turnover * rise * v2 / g) : T(0.0);
  const Matrix3<T> I = Matrix3<T>::Identity();

  Bristle<T> b;
  const Vector3<T> stretch = u - turnover * state.zeta;  // zeta' / sigma_0
  const Matrix3<T> stretch_u = I - (T(2.0) * by_square) * (state.zeta * u.transpose());
  b.rate = c.bristle_stiffness * stretch;
  b.rate_u = c.bristle_stiffness * stretch_u;
  b.rate_zeta = (-c.bristle_stiffness * turnover) * I;
  b.mu = state.zeta + c.bristle_damping * stretch;
  b.mu_u = c.bristle_damping * stretch_u;
  b.mu_zeta = (T(1.0) - c.bristle_damping * turnover) * I;
  return b;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FORCES_LUGRE_H_
