// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/bristle.h"
#include "forces/friction_numbers.h"
#include "math/euler_parameters.h"

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
  const T speed = is_less(T(0.0), square, true) ? T(sqrt(square)) : T(0.0);
  const T g = c.mu_dynamic + (c.mu_static - c.mu_dynamic) * exp(-square * v2);
  const Vector3<T> stretch = u - speed / g * state.zeta;  // zeta' / sigma_0 [m/s]

  Bristle<T> b;
  b.rate = c.bristle_stiffness * stretch;
  b.mu = state.zeta + c.bristle_damping * stretch;
  return b;
}

}  // namespace codesign
