// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "elements/rotor.h"
#include "elements/spring.h"
#include "elements/state_view.h"
#include "forces/joint_stop.h"

namespace codesign {

// The mechanical energy [J], theory (14b).

/// The elastic energy of the torsion spring and of the stops of one joint coordinate, k (theta - theta_0)^2/2 and the integral of k delta.
template <class T>
T joint_energy(const StateView<T>& view, const JointLoad& load) {
  const JointDynamicsConstants<T>& d = view.dynamics(load.pair, load.element);
  const T position = view.coordinate_value(load.pair, load.element);
  T energy(0.0);
  if (load.spring) {
    const T turned = position - d.free_position;
    energy += T(0.5) * d.stiffness * turned * turned;
  }
  if (load.stop) {
    const LimitOptions& stop = view.system.study().limits;
    const T below = d.lower - position, above = position - d.upper;
    energy += stop_energy(above, stop.stiffness, stop.width) + stop_energy(below, stop.stiffness, stop.width);
  }
  return energy;
}

/// With a forest: kinetic energy of the bodies, potential energy of gravity [J], zero if every centre of mass is at the ground's origin,
/// and the power of all forces but gravity [W], W' of (17a), if the motion satisfies the constraints. The velocity terms of (9) have no
/// power.
/// @param bodies resized; per body the centre of mass in ground axes [m], its velocity [m/s] and the angular velocity [rad/s] in body axes.
template <class T>
VectorX<T> body_energies(const StateView<T>& view, VectorX<T>* bodies) {
  constexpr int kPerBody = 9;
  bodies->resize(kPerBody * view.layout.bodies);
  VectorX<T> sums = VectorX<T>::Constant(3, T(0.0));
  for (int b = 0; b < view.layout.bodies; ++b) {
    const AxesMotion<T>& m = view.motion.body(b);
    const BodyConstants<T>& c = view.design.constants.bodies[to_index(b)];
    sums[0] += T(0.5) * (c.mass * dot<T>(m.velocity, m.velocity) + dot<T>(m.omega, c.J * m.omega));
    sums[1] -= c.mass * dot<T>(view.design.gravity, m.r);
    sums[2] += c.mass * dot<T>(m.velocity, m.acceleration) + dot<T>(m.omega, c.J * m.alpha);
    bodies->template segment<kPerBody>(kPerBody * b) << m.r, m.velocity, m.omega;
  }
  return sums;
}

/// T of (14b): translation and rotation of all bodies, and the contribution of the spin of rotors, theory (9a).
template <class T>
T kinetic_energy(const StateView<T>& view) {
  T energy(0.0);
  for (int b = 0; b < view.layout.bodies; ++b) {
    const BodyKinematics<T>& k = view.body(b);
    const BodyConstants<T>& constants = view.design.constants.bodies[to_index(b)];
    const Vector3<T> omega = body_omega(k);
    energy += T(0.5) * (constants.mass * dot<T>(k.rd, k.rd) + dot<T>(omega, constants.J * omega));
  }
  for (const Rotor& rotor : view.system.rotors()) energy += rotor_energy(view, rotor);
  return energy;
}

/// V of (14b): gravity (zero at the root's origin), spring-dampers, torsion springs and stops.
template <class T>
T potential_energy(const StateView<T>& view) {
  T energy(0.0);
  for (int b = 0; b < view.layout.bodies; ++b) {
    const T& mass = view.design.constants.bodies[to_index(b)].mass;
    energy -= mass * dot<T>(view.design.gravity, view.body(b).r);
  }
  for (std::size_t k = 0; k < view.design.constants.springs.size(); ++k) energy += spring_energy_at(view, k);
  for (const JointLoad& load : view.system.loads())
    if (load.needs_position()) energy += joint_energy(view, load);
  return energy;
}

}  // namespace codesign
