// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/contact.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "forces/friction_curves.h"

namespace codesign {

/// S(u) of a law without states, with the numbers against the axis where the law has them.
template <class T>
T sliding_friction(const FrictionLaw& law, bool directional, const T& u, const FrictionConstants<T>& c) {
  const auto S = [&law](const T& v, const T& mu_s, const T& mu_d, const T& v_t) { return law.curve.of<T>(v, mu_s, mu_d, v_t); };
  if (directional && law.directional) return directional_friction<T>(S, u, c);
  return S(u, c.mu_static, c.mu_dynamic, c.transition_velocity);
}

/// The load L of friction that depends on the reaction, along one joint coordinate [N or N m]; positive against the coordinate; theory (13)
/// with S from (10) or (48), or mu of (13e), (13f) in its place.
/// @param rate of the coordinate. @param state receives velocity, normal force and load, if not null.
template <class T>
T reaction_friction(const StateView<T>& view, const JointLoad& load, const T& rate, std::common_type_t<FrictionState<T>*> state) {
  const FrictionConstants<T>& c = view.constants(load.pair).friction;
  const bool turning = view.coordinate_constants(load.pair, load.element).kind == CoordinateConstants<T>::Kind::kTurn;
  const T N = normal_force(view, load.pair);
  const T radius = turning ? c.pin_radius : T(1.0);
  const T u = radius * rate;
  T mu;
  if (const BristleContact* bristle = view.system.bristle(load.pair, load.element))
    mu = bristle_law<T>(*bristle, Vector3<T>(u, T(0.0), T(0.0)), view.state->s, c).mu[0];
  else
    mu = sliding_friction<T>(view.system.friction_law(load.pair), load.directional, u, c);
  const T viscous = load.directional ? directional_viscous<T>(rate, radius, c) : T(c.viscous * rate);
  const T value = radius * mu * N + viscous;
  if (state) *state = {rate, N, value};
  return value;
}

}  // namespace codesign
