// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "elements/body.h"
#include "elements/contact.h"
#include "elements/controllers.h"
#include "elements/elastic_gear.h"
#include "elements/loads.h"
#include "elements/normal_force.h"
#include "elements/state_view.h"
#include "elements/winding.h"
#include "forces/compliance.h"
#include "forces/control_law.h"
#include "forces/friction_curves.h"
#include "forces/gear.h"
#include "math/arrays.h"

namespace codesign {

/// S(u) of a law without states, with the numbers against the axis where the law has them.
template <class T>
T sliding_friction(const FrictionLaw& law, bool directional, const T& u,
                   const FrictionConstants<T>& c) {
  const auto S = [&](const T& v, const T& mu_s, const T& mu_d) {
    return law.curve.of<T>(v, mu_s, mu_d, c);
  };
  if (directional && law.directional) return directional_friction<T>(S, u, c);
  return S(u, c.mu_static, c.mu_dynamic);
}

/// The viscous part of annotated friction [N or N m], theory (13), (10a), (48).
/// @param rate of the coordinate. @param radius sliding velocity per rate.
template <class T>
T viscous_load(const BearingFriction& friction, const T& rate, const T& radius,
               const FrictionConstants<T>& c) {
  const T linear =
      friction.directional ? directional_viscous<T>(rate, radius, c) : T(c.viscous * rate);
  if (!friction.viscous_power) return linear;
  return linear * viscous_power<T>(rate, T(c.transition_velocity / radius), c.viscous_exponent);
}

/// The load L of annotated friction along one joint coordinate [N or N m], positive against the
/// coordinate; theory (13) with S from (10), (10a) or (48), or mu of (13e), (13f) in its place. N
/// is that of the reaction, or 1 for friction that is given directly.
/// @param rate of the coordinate. @param state receives velocity, normal force and load, if not
/// null.
template <class T>
T annotated_friction(const StateView<T>& view, const JointLoad& load,
                     const BearingFriction& friction, const T& rate,
                     std::common_type_t<FrictionState<T>*> state) {
  const FrictionConstants<T>& c = view.constants(load.pair).friction;
  const bool turning = view.coordinate_constants(load.pair, load.element).kind ==
                       CoordinateConstants<T>::Kind::kTurn;
  const T N = friction.direct ? T(1.0) : normal_force(view, load.pair);
  const T radius = turning ? c.pin_radius : T(1.0);
  const T u = radius * rate;
  T mu;
  if (const BristleContact* bristle = view.system.bristle(load.pair, load.element))
    mu = bristle_law<T>(*bristle, Vector3<T>(u, T(0.0), T(0.0)), view.state->s, c).mu[0];
  else
    mu = sliding_friction<T>(view.system.friction_law(load.pair), friction.directional, u, c);
  const T value = radius * mu * N + viscous_load(friction, rate, radius, c);
  if (state) *state = {rate, friction.direct ? T(0.0) : N, value};
  return value;
}

// Loads along joint coordinates [N or N m], theory (13). A load L is positive against the
// coordinate, so that J^T L is added to the rows of motion; an effort (of a controller, or of a
// load) is positive along the coordinate and counts as -L.

/// The decisions of stops, as parts for name_part().
constexpr int kUpperStop = 0, kLowerStop = 1;

template <class T>
const StopConstants<T>& stop_of(const StateView<T>& view, const JointLoad& load) {
  return view.dynamics(load.pair, load.element).stop;
}

/// L of both stops of a coordinate [N or N m], theory (13d): positive beyond the upper limit,
/// negative beyond the lower one.
/// @param rate of the coordinate. @param dissipation c of (13d) [s/m or s/rad]; 0 leaves the
/// elastic part.
template <class T>
T stop_load(const StateView<T>& view, const JointLoad& load, const T& rate, const T& dissipation) {
  const JointDynamicsConstants<T>& d = view.dynamics(load.pair, load.element);
  const StopConstants<T>& stop = stop_of(view, load);
  const T position = view.coordinate_value(load.pair, load.element), below = d.lower - position,
          above = position - d.upper;
  const NamedSwitches<T> named(position, load);
  name_part(position, kUpperStop);
  const T at_upper = joint_stop<T>(above, rate, stop.stiffness, dissipation, stop.width);
  name_part(position, kLowerStop);
  return at_upper - joint_stop<T>(below, T(-rate), stop.stiffness, dissipation, stop.width);
}

/// The part of stop_load() that takes energy from the motion, k delta (h - 1): the load less its
/// elastic part.
template <class T>
T stop_dissipation(const StateView<T>& view, const JointLoad& load, const T& rate) {
  const T elastic = stop_load(view, load, rate, T(0.0));
  return stop_load(view, load, rate, stop_of(view, load).dissipation) - elastic;
}

/// n K i, theory (9d) [N m or N].
template <class T>
T winding_effort(const StateView<T>& view, const WindingTorque& torque) {
  const Winding& winding = view.system.windings()[to_index(torque.winding)];
  return effort_per_current(view, winding) * winding_current(view, winding);
}

/// The sum of the controllers' outputs on a coordinate that are efforts, bounded by the actuator's
/// limit (13c) if the study enforces `<limit effort>`.
template <class T>
T controller_effort(const StateView<T>& view, const JointLoad& load) {
  T demand(0.0);
  const auto* effort = load.find<ControllerEffort>();
  if (!effort) return demand;
  for (int controller : effort->controllers) demand += drive_effort(view, controller);
  if (!effort->saturated) return demand;
  const T& limit = view.dynamics(load.pair, load.element).effort;
  return saturate(demand, limit).value;
}

/// What controllers and motor apply to a coordinate.
template <class T>
T applied_effort(const StateView<T>& view, const JointLoad& load) {
  const T effort = controller_effort(view, load);
  const auto* torque = load.find<WindingTorque>();
  return torque ? T(effort + winding_effort(view, *torque)) : effort;
}

template <class T>
T gear_load(const StateView<T>& view, const JointLoad& load, const T& rate);

// part_load(): the load L of one kind. @param rate of the coordinate.

template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const BearingFriction& friction,
            const T& rate) {
  return annotated_friction(view, load, friction, rate, nullptr);
}

/// L of damping and torsion spring, end of theory (13).
template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const PassiveLoad& passive,
            const T& rate) {
  const JointDynamicsConstants<T>& d = view.dynamics(load.pair, load.element);
  T value = (d.damping + d.spring_damping) * rate;
  if (passive.has_spring)
    value += d.stiffness * (view.coordinate_value(load.pair, load.element) - d.free_position);
  return value;
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const DryFriction&, const T& rate) {
  const int joint = view.pair(load.pair).chain[to_index(load.element)].joint;
  const double v_t = view.system.robot().joints[to_index(joint)].dry_transition_velocity;
  return view.dynamics(load.pair, load.element).dry_friction *
         brown_mcphee<T>(rate, T(1.0), T(1.0), T(v_t));
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const StopLoad&, const T& rate) {
  return stop_load(view, load, rate, stop_of(view, load).dissipation);
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad&, const ElasticGearSide& side, const T&) {
  const T tau = elastic_torque(view, side.gear);
  return side.is_motor ? tau : T(-tau);
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad&, const GivenEffort& given, const T&) {
  return -load_value(view, view.design.loads[to_index(given.load)].effort,
                     view.system.load_signals()[to_index(given.load)].effort);
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const GearLoss&, const T& rate) {
  return gear_load(view, load, rate);
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad& load, const ControllerEffort&, const T&) {
  return -controller_effort(view, load);
}

template <class T>
T part_load(const StateView<T>& view, const JointLoad&, const WindingTorque& torque, const T&) {
  return -winding_effort(view, torque);
}

// powered_load(): what of it has the kind of power that it is counted with; forces of springs have
// none.

template <class T, class Part>
T powered_load(const StateView<T>& view, const JointLoad& load, const Part& part, const T& rate) {
  return part_load(view, load, part, rate);
}
template <class T>
T powered_load(const StateView<T>& view, const JointLoad& load, const PassiveLoad&, const T& rate) {
  return part_load(view, load, PassiveLoad{}, rate);
}
template <class T>
T powered_load(const StateView<T>& view, const JointLoad& load, const StopLoad&, const T& rate) {
  return stop_dissipation(view, load, rate);
}

// part_energy(): the elastic energy [J], theory (14b).

template <class T, class Part>
T part_energy(const StateView<T>&, const JointLoad&, const Part&) {
  return T(0.0);
}
/// k (theta - theta_0)^2/2
template <class T>
T part_energy(const StateView<T>& view, const JointLoad& load, const PassiveLoad& passive) {
  if (!passive.has_spring) return T(0.0);
  const JointDynamicsConstants<T>& d = view.dynamics(load.pair, load.element);
  const T turned = view.coordinate_value(load.pair, load.element) - d.free_position;
  return T(0.5) * d.stiffness * turned * turned;
}
/// The integral of k delta.
template <class T>
T part_energy(const StateView<T>& view, const JointLoad& load, const StopLoad&) {
  const JointDynamicsConstants<T>& d = view.dynamics(load.pair, load.element);
  const T position = view.coordinate_value(load.pair, load.element), below = d.lower - position,
          above = position - d.upper;
  return stop_energy<T>(above, d.stop.stiffness, d.stop.width) +
         stop_energy<T>(below, d.stop.stiffness, d.stop.width);
}

/// What acts on the joint's own side of a gear.
template <class T>
T link_load(const StateView<T>& view, const JointLoad& load, const T& rate) {
  T value(0.0);
  load.for_each([&](const auto& part) {
    if constexpr (!std::decay_t<decltype(part)>::kBehindGear)
      value += part_load(view, load, part, rate);
  });
  return value;
}

/// The sum of c lambda of the couplings of a coordinate [N or N m]: of its drive, which acts on the
/// motor's side of a gear, or of all others, which act on the joint's side; theory (8a), (28).
template <class T>
T coupling_load(const StateView<T>& view, int pair, int element, bool of_drive) {
  T value(0.0);
  for (std::size_t k = 0; k < view.design.constants.couplings.size(); ++k) {
    const Coupling& coupling = view.system.topology().couplings[k];
    if (coupling.is_drive != of_drive) continue;
    const int row = view.layout.lambda_column(view.layout.coupling_row(static_cast<int>(k)));
    for (std::size_t t = 0; t < coupling.terms.size(); ++t)
      if (coupling.terms[t].pair == pair && coupling.terms[t].element == element)
        value += view.design.constants.couplings[k].coefficients[t] * view.state->z[row];
  }
  return value;
}

/// The torque tau that the gear of a coordinate transmits to the joint [N m or N], positive along
/// the coordinate; theory (9b): that of the spring behind a motor, an unknown of a cut pair, else
/// what the child and the loads on the joint's side need.
template <class T>
T gear_torque(const StateView<T>& view, const JointLoad& load, const T& rate) {
  const auto* side = load.find<ElasticGearSide>();
  if (side && side->is_motor) return elastic_torque(view, side->gear);
  if (load.gear_unknown >= 0) return view.state->z[view.layout.gear_column(load.gear_unknown)];
  const auto body = to_index(view.layout.forest.body_below[to_index(load.pair)]);
  std::array<T, 6> rows;
  carry_back(transmitted_wrench(view, static_cast<int>(body)), view.constants(load.pair),
             view.motion.poses[body],
             view.state->q.data() + view.layout.column(static_cast<int>(body)), rows.data());
  return rows[to_index(load.element)] + link_load(view, load, rate) +
         coupling_load(view, load.pair, load.element, false);
}

/// The friction of a gear's flanks per pressure, mu of theory (9b).
template <class T>
T gear_slip(const StateView<T>& view, const JointLoad& load, const T& rate) {
  const FrictionConstants<T>& c = view.dynamics(load.pair, load.element).gear.slip;
  if (const BristleContact* bristle = view.system.bristle(load.pair, load.element, true))
    return bristle_law<T>(*bristle, Vector3<T>(rate, T(0.0), T(0.0)), view.state->s, c).mu[0];
  return sliding_friction(view.system.gear_law(load.pair, load.element), false, rate, c);
}

/// The load L of gear and motor, theory (9b): the loss of the flanks and the friction of the
/// motor's side.
template <class T>
T gear_load(const StateView<T>& view, const JointLoad& load, const T& rate) {
  const GearConstants<T>& c = view.dynamics(load.pair, load.element).gear;
  const T mu = gear_slip(view, load, rate);
  T value = mu * c.coulomb + c.viscous * rate;
  if (load.has_gear_torque) value += gear_loss(gear_torque(view, load, rate), mu, c);
  return value;
}

/// The whole load L along a coordinate. The effort of a given motion is not part of it: it is a
/// multiplier.
template <class T>
T joint_load(const StateView<T>& view, const JointLoad& load, const T& rate) {
  T value(0.0);
  load.for_each([&](const auto& part) { value += part_load(view, load, part, rate); });
  return value;
}

/// What of the load L along a coordinate has this kind of power.
template <class T>
T load_of_kind(const StateView<T>& view, PowerKind kind, const JointLoad& load, const T& rate) {
  T value(0.0);
  load.for_each([&](const auto& part) {
    if (part.kPower == kind) value += powered_load(view, load, part, rate);
  });
  return value;
}

/// Sets the row of a transmitted torque that is an unknown, theory (9b): tau is the effort of
/// controllers and drives less the load of the rotor and of gear_load().
template <class T>
void gear_residual(const StateView<T>& view, const JointLoad& load, VectorX<T>* G) {
  if (load.gear_unknown < 0) return;
  const T rate = view.coordinate(load.pair, load.element, CoordinateDetail::kRate).rate;
  const int column = view.layout.gear_column(load.gear_unknown);
  T value = view.state->z[column] + coupling_load(view, load.pair, load.element, true);
  load.for_each([&](const auto& part) {
    if constexpr (std::decay_t<decltype(part)>::kBehindGear)
      value += part_load(view, load, part, rate);
  });
  for (const Rotor& rotor : view.system.rotors())
    if (rotor.pair == load.pair && rotor.element == load.element) value += rotor_load(view, rotor);
  (*G)[column] = value;
}

/// Adds J^T L to the rows of motion.
template <class T>
void load_residual(const StateView<T>& view, Workspace<T>* workspace, const JointLoad& load,
                   VectorX<T>* G) {
  const CoordinateMotion<T>& motion =
      view.coordinate(load.pair, load.element, CoordinateDetail::kRate);
  const T value = joint_load(view, load, motion.rate);
  add_coordinate_load(view, workspace, load.pair, load.element, motion.J, value, G);
}

/// Friction of a joint coordinate for observers: its rate, normal force and load L, of
/// `<codesign:friction>`, `<dynamics friction>` and gear.
template <class T>
FrictionState<T> joint_friction(const StateView<T>& view, int pair, int element) {
  const T rate = view.coordinate(pair, element, CoordinateDetail::kRate).rate;
  FrictionState<T> state;
  for (const JointLoad& load : view.system.loads()) {
    if (load.pair != pair || load.element != element) continue;
    state.velocity = rate;
    if (const auto* friction = load.find<BearingFriction>())
      annotated_friction(view, load, *friction, rate, &state);
    if (const auto* dry = load.find<DryFriction>()) state.load += part_load(view, load, *dry, rate);
    if (load.find<GearLoss>()) state.load += gear_load(view, load, rate);
  }
  return state;
}

/// The effort that controllers apply along a coordinate or on its motor, within the actuator's
/// limit, and the effort of its drive; positive along the coordinate.
template <class T>
T joint_effort(const StateView<T>& view, int pair, int element) {
  const CoordinateIndex motor = view.system.motor_of(pair, element);
  T sum(0.0);
  for (const JointLoad& load : view.system.loads())
    if (load.pair == motor.pair && load.element == motor.element) sum += applied_effort(view, load);
  return sum - coupling_load(view, pair, element, true);
}

}  // namespace codesign
