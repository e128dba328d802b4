// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ENERGY_H_
#define MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ENERGY_H_

#include "equations/equations.h"
#include "equations/equations_springs.h"
#include "forces/joint_stop.h"

namespace codesign {

// Energies, theory (14b).

template <class T>
T Equations<T>::kinetic_energy(SparseGradient<T>* gradient) const {
  T energy(0.0);
  for (int b = 0; b < layout_.bodies; ++b) {
    const BodyKinematics<T>& k = body(b);
    const BodyConstants<T>& constants = constants_.bodies[static_cast<std::size_t>(b)];
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
  for (const Rotor& rotor : system_.rotors()) energy += rotor_energy(rotor, gradient);
  return energy;
}

template <class T>
T Equations<T>::potential_energy(SparseGradient<T>* gradient) const {
  T energy(0.0);
  for (int b = 0; b < layout_.bodies; ++b) {
    const T& mass = constants_.bodies[static_cast<std::size_t>(b)].mass;
    energy -= mass * dot<T>(gravity_, body(b).r);
    for (int l = 0; gradient && l < 3; ++l) gradient->position.push_back({kBodySize * b + l, T(-mass * gravity_[l])});
  }
  for (std::size_t k = 0; k < constants_.springs.size(); ++k) energy += spring_energy(k, gradient);
  for (const JointLoad& load : system_.loads())
    if (load.needs_position()) energy += joint_energy(load, gradient);
  return energy;
}

template <class T>
T Equations<T>::spring_energy(std::size_t k, SparseGradient<T>* gradient) const {
  const SpringDamperConstants<T>& c = constants_.springs[k];
  const Vector3<T> d = displacement_motion(body(c.body_i), c.s_i, body(c.body_j), c.s_j).x;
  if (gradient) {
    const Vector3<T> pull = spring_damper<T>(d, Vector3<T>::Zero(), c.stiffness, T(0.0), c.free_length).pull;
    for (const internal::SpringEnd<T>& end : spring_ends(k)) end.append(end.D, pull, &gradient->position);
  }
  return codesign::spring_energy<T>(d, c.stiffness, c.free_length);
}

// Of a torsion spring and of the stops of one coordinate.
template <class T>
T Equations<T>::joint_energy(const JointLoad& load, SparseGradient<T>* gradient) const {
  const JointDynamicsConstants<T>& d =
      constants_.pairs[static_cast<std::size_t>(load.pair)].dynamics[static_cast<std::size_t>(load.element)];
  const T position = coordinate_value(load.pair, load.element);
  T energy(0.0), force(0.0);
  if (load.spring) {
    const T turned = position - d.free_position;
    energy += T(0.5) * d.stiffness * turned * turned;
    force += d.stiffness * turned;
  }
  if (load.stop) {
    const LimitOptions& stop = system_.study().limits;
    const T below = d.lower - position, above = position - d.upper;
    const auto held = [&stop](const T& excess) { return joint_stop(excess, T(0.0), stop.stiffness, 0.0, stop.width).value; };
    energy += stop_energy(above, stop.stiffness, stop.width) + stop_energy(below, stop.stiffness, stop.width);
    force += held(above) - held(below);
  }
  if (gradient)
    append_local(load.pair, coordinate(load.pair, load.element).position_q, force, coordinate_moves_r(load.pair, load.element),
                 &gradient->position);
  return energy;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_EQUATIONS_EQUATIONS_ENERGY_H_
