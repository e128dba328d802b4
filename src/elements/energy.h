// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ELEMENTS_ENERGY_H_
#define MECHANISM_CODESIGN_ELEMENTS_ENERGY_H_

#include "elements/gradient_rows.h"
#include "elements/rotor.h"
#include "elements/spring.h"
#include "elements/state_view.h"
#include "forces/joint_stop.h"

namespace codesign {

// The mechanical energy [J], theory (14b). Each function appends its gradient by positions and velocities if `gradient` is not null.

/// The elastic energy of the torsion spring and of the stops of one joint coordinate, k (theta - theta_0)^2/2 and the integral of k delta.
template <class T>
T joint_energy(const StateView<T>& view, const JointLoad& load, OptionalGradient<T> gradient) {
  const JointDynamicsConstants<T>& d =
      view.design.constants.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
  const T position = view.coordinate_value(load.pair, load.element);
  T energy(0.0), force(0.0);
  if (load.spring) {
    const T turned = position - d.free_position;
    energy += T(0.5) * d.stiffness * turned * turned;
    force += d.stiffness * turned;
  }
  if (load.stop) {
    const LimitOptions& stop = view.system.study().limits;
    const T below = d.lower - position, above = position - d.upper;
    const auto held = [&stop](const T& excess) { return joint_stop(excess, T(0.0), stop.stiffness, 0.0, stop.width).value; };
    energy += stop_energy(above, stop.stiffness, stop.width) + stop_energy(below, stop.stiffness, stop.width);
    force += held(above) - held(below);
  }
  if (gradient)
    append_local(view, load.pair, view.coordinate(load.pair, load.element).position_q, force,
                 view.coordinate_moves_r(load.pair, load.element), &gradient->position);
  return energy;
}

/// T of (14b): translation and rotation of all bodies, and the contribution of the spin of rotors, theory (9a).
template <class T>
T kinetic_energy(const StateView<T>& view, OptionalGradient<T> gradient) {
  T energy(0.0);
  for (int b = 0; b < view.layout.bodies; ++b) {
    const BodyKinematics<T>& k = view.body(b);
    const BodyConstants<T>& constants = view.design.constants.bodies[static_cast<std::size_t>(b)];
    const Vector3<T> omega = T(2.0) * body_rate(k.p, k.pd), momentum = constants.J * omega;
    energy += T(0.5) * (constants.mass * dot<T>(k.rd, k.rd) + dot<T>(omega, momentum));
    if (!gradient) continue;
    const int c = kBodySize * b;
    for (int l = 0; l < 3; ++l) gradient->velocity.push_back({c + l, T(constants.mass * k.rd[l])});
    const Vector4<T> by_pd = T(2.0) * body_rate_transposed(k.p, momentum), by_p = T(-2.0) * body_rate_transposed(k.pd, momentum);
    for (int e = 0; e < 4; ++e) {
      gradient->velocity.push_back({c + 3 + e, by_pd[e]});
      gradient->position.push_back({c + 3 + e, by_p[e]});
    }
  }
  for (const Rotor& rotor : view.system.rotors()) energy += rotor_energy(view, rotor, gradient);
  return energy;
}

/// V of (14b): gravity (zero at the root's origin), spring-dampers, torsion springs and stops.
template <class T>
T potential_energy(const StateView<T>& view, OptionalGradient<T> gradient) {
  T energy(0.0);
  for (int b = 0; b < view.layout.bodies; ++b) {
    const T& mass = view.design.constants.bodies[static_cast<std::size_t>(b)].mass;
    energy -= mass * dot<T>(view.design.gravity, view.body(b).r);
    for (int l = 0; gradient && l < 3; ++l) gradient->position.push_back({kBodySize * b + l, T(-mass * view.design.gravity[l])});
  }
  for (std::size_t k = 0; k < view.design.constants.springs.size(); ++k) energy += spring_energy_at(view, k, gradient);
  for (const JointLoad& load : view.system.loads())
    if (load.needs_position()) energy += joint_energy(view, load, gradient);
  return energy;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ELEMENTS_ENERGY_H_
