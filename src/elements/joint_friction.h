// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/bristle.h"
#include "elements/friction_state.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "forces/directional_friction.h"

namespace codesign {

/// The load L of friction that depends on the reaction, along one joint coordinate [N or N m]; positive against the coordinate; theory (13)
/// with S from (10) or (48), or mu of (13e), (13f) in its place.
/// @param rate of the coordinate. @param state receives velocity, normal force and load, if not null.
template <class T>
T reaction_friction(const StateView<T>& view, const JointLoad& load, const T& rate, std::common_type_t<FrictionState<T>*> state) {
  const int pair = load.pair, element = load.element;
  const auto p = static_cast<std::size_t>(pair);
  const FrictionConstants<T>& c = view.design.constants.pairs[p].friction;
  const bool turning =
      view.design.constants.pairs[p].coordinates[static_cast<std::size_t>(element)].kind == CoordinateConstants<T>::Kind::kTurn;
  const T N = normal_force(view, pair);
  const T radius = turning ? c.pin_radius : T(1.0);
  const T u = radius * rate;
  T mu;
  if (const BristleContact* bristle = view.system.bristle(pair, element))
    mu = bristle_law<T>(*bristle, Vector3<T>(u, T(0.0), T(0.0)), view.state->s, c).mu[0];
  else
    mu = load.directional ? directional_brown_mcphee<T>(u, c) : brown_mcphee<T>(u, c.mu_static, c.mu_dynamic, c.transition_velocity);
  const T viscous = load.directional ? directional_viscous<T>(rate, radius, c) : T(c.viscous * rate);
  const T value = radius * mu * N + viscous;
  if (state) *state = {rate, N, value};
  return value;
}

}  // namespace codesign
