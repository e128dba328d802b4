// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/signal_table.h"
#include "elements/body.h"
#include "elements/contact.h"
#include "elements/elastic_gear.h"
#include "elements/joint_load.h"
#include "elements/link_elements.h"
#include "elements/loads.h"
#include "elements/state_view.h"
#include "forces/compliance.h"
#include "math/arrays.h"

namespace codesign {

// The powers [W] of theory (14c), positive where energy goes into the mechanism. A load L opposes
// the coordinate, so its power is -L theta'.

/// The power of one kind along one joint coordinate; zero if no load of that kind acts there.
template <class T>
T load_power(const StateView<T>& view, PowerKind kind, const JointLoad& load) {
  if (!load.has_power(kind)) return T(0.0);
  const T rate = view.coordinate(load.pair, load.element, CoordinateDetail::kRate).rate;
  return -load_of_kind(view, kind, load, rate) * rate;
}

/// The power of the drive of one pair's coordinate, or of all drives (pair -1); theory (28).
template <class T>
T drive_power(const StateView<T>& view, int pair, int element) {
  T sum(0.0);
  for (const Coupling& coupling : view.system.topology().couplings) {
    const CouplingTerm& at = coupling.terms.front();
    if (!coupling.is_drive || (pair >= 0 && (at.pair != pair || at.element != element))) continue;
    sum -= coupling_load(view, at.pair, at.element, true) *
           view.coordinate(at.pair, at.element, CoordinateDetail::kRate).rate;
  }
  return sum;
}

/// The power of one kind summed over the whole mechanism.
template <class T>
T total_power(const StateView<T>& view, PowerKind kind) {
  T sum(0.0);
  for (const JointLoad& load : view.system.loads()) sum += load_power(view, kind, load);
  if (kind == PowerKind::kActuator) sum += drive_power(view, -1, -1);
  if (kind == PowerKind::kFriction)
    for (int pair : view.system.contacts()) sum -= contact_at(view, pair).power();
  add_link_element_power(view, kind, &sum);
  if (kind == PowerKind::kDamping)
    for (std::size_t k = 0; k < view.system.elastic_gears().size(); ++k)
      sum += elastic_power(view, static_cast<int>(k));
  if (kind == PowerKind::kLoad)
    for (std::size_t k = 0; k < view.system.link_loads().size(); ++k)
      sum += link_load_power(view, k);
  return sum;
}

/// The power of one kind in one joint and its motor: a pair and the index in its chain.
/// Elements between links and loads on links belong to no joint.
template <class T>
T joint_power(const StateView<T>& view, PowerKind kind, int pair, int element) {
  const Pair& p = view.pair(pair);
  const auto elements = static_cast<int>(p.chain.size());
  T sum(0.0);
  // A cylindrical loop is one joint with two coordinates: the index of the second one is beyond the
  // chain.
  for (const JointLoad& load : view.system.loads())
    if (load.pair == pair && (load.element == element || load.element >= elements))
      sum += load_power(view, kind, load);
  if (const int gear = elastic_gear_of(view.system, pair, element); gear >= 0) {
    for (const JointLoad& load : view.system.loads())
      if (const auto* side = load.find<ElasticGearSide>();
          side && side->is_motor && side->gear == gear)
        sum += load_power(view, kind, load);
    if (kind == PowerKind::kDamping) sum += elastic_power(view, gear);
  }
  if (kind == PowerKind::kActuator) sum += drive_power(view, pair, element);
  const bool holds_friction = p.chain[to_index(element)].joint == p.friction_joint;
  if (kind == PowerKind::kFriction && holds_friction && slips_isotropically(p.kind))
    sum -= contact_at(view, pair).power();
  return sum;
}

// The mechanical energy [J], theory (14b).

/// The elastic energy of the torsion spring and of the stops of one joint coordinate.
template <class T>
T joint_energy(const StateView<T>& view, const JointLoad& load) {
  T energy(0.0);
  load.for_each([&](const auto& part) { energy += part_energy(view, load, part); });
  return energy;
}

/// With a forest: kinetic energy of the bodies, potential energy of gravity [J], zero if every
/// centre of mass is at the ground's origin, and the power of all forces but gravity [W], W' of
/// (17a), if the motion satisfies the constraints. The velocity terms of (9) have no power.
/// @param bodies resized; per body the centre of mass in ground axes [m], its velocity [m/s] and
/// the angular velocity [rad/s] in body axes.
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

/// T of (14b): translation and rotation of all bodies, and the contribution of the spin of rotors,
/// theory (9a).
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

/// V of (14b): gravity (zero at the root's origin), elements between links, torsion springs, stops
/// and elastic gears.
template <class T>
T potential_energy(const StateView<T>& view) {
  T energy(0.0);
  for (int b = 0; b < view.layout.bodies; ++b) {
    const T& mass = view.design.constants.bodies[to_index(b)].mass;
    energy -= mass * dot<T>(view.design.gravity, view.body(b).r);
  }
  add_link_element_energy(view, &energy);
  for (const JointLoad& load : view.system.loads()) energy += joint_energy(view, load);
  for (std::size_t k = 0; k < view.system.elastic_gears().size(); ++k)
    energy += elastic_energy(view, static_cast<int>(k));
  return energy;
}

}  // namespace codesign
