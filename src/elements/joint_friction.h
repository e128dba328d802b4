// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_JOINT_FRICTION_H_
#define MECHANISM_CODESIGN_ELEMENTS_JOINT_FRICTION_H_

#include "elements/bristle.h"
#include "elements/friction_state.h"
#include "elements/gradient_rows.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "forces/directional_friction.h"

namespace codesign {

/// The load L of friction that depends on the reaction, along one joint coordinate [N or N m]; positive against the coordinate; theory (13)
/// with S from (10) or (48), or mu of (13e), (13f) in its place. Appends its gradient if requested; `motion` then needs detail kGradient.
/// @param state receives velocity, normal force and load, if not null.
template <class T>
T reaction_friction(const StateView<T>& view, const JointLoad& load, const CoordinateMotion<T>& motion, OptionalGradient<T> gradient,
                    std::common_type_t<FrictionState<T>*> state) {
  const int pair = load.pair, element = load.element;
  const auto p = static_cast<std::size_t>(pair);
  const FrictionConstants<T>& c = view.design.constants.pairs[p].friction;
  const bool turning =
      view.design.constants.pairs[p].coordinates[static_cast<std::size_t>(element)].kind == CoordinateConstants<T>::Kind::kTurn;
  const NormalForce<T> N = normal_force(view, pair);
  const T radius = turning ? c.pin_radius : T(1.0);
  const BristleContact* const bristle = view.system.bristle(pair, element);
  Bristle<T> law;
  FrictionCoefficient<T> S;
  if (bristle) {
    law = bristle_law<T>(*bristle, Vector3<T>(radius * motion.rate, T(0.0), T(0.0)), view.state->s, c);
    S = {law.mu[0], law.mu_u(0, 0)};
  } else {
    S = load.directional ? directional_brown_mcphee<T>(radius * motion.rate, c)
                         : brown_mcphee<T>(radius * motion.rate, c.mu_static, c.mu_dynamic, c.transition_velocity);
  }
  const ValueAndSlope<T> viscous =
      load.directional ? directional_viscous<T>(motion.rate, radius, c) : ValueAndSlope<T>{T(c.viscous * motion.rate), c.viscous};
  if (state) *state = {motion.rate, N.value, T(radius * S.value * N.value + viscous.value)};
  if (gradient) {
    const T slope = radius * radius * S.slope * N.value + viscous.slope;
    append_rate(view, pair, element, motion, slope, gradient);
    append_normal_gradient(view, pair, N.F, N.torque, T(radius * S.value), gradient);
    const T per_coefficient = radius * N.value;
    if (bristle)
      append_bristle_states(view, *bristle, Vector3<T>(per_coefficient * law.mu_zeta.row(0).transpose()),
                            T(per_coefficient * law.mu_dwell[0]), gradient);
  }
  return radius * S.value * N.value + viscous.value;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_JOINT_FRICTION_H_
