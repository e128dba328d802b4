// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>

#include "description/signal_kind.h"
#include "math/arrays.h"

namespace codesign {

struct JointDescription;

/// What has a quantity.
enum class SignalOwner { kJoint, kController, kLink, kSpring, kContact, kMechanism };

/// What there is to know of a quantity besides its value.
struct SignalFacts {
  SignalKind kind;
  SignalOwner owner;
  const char* quantity;  ///< as files spell it; empty if they do not
  /// q and Q stand for the units of position and effort of the joint, or of the joint that a
  /// controller drives; e for that of a controller's input
  const char* unit;
  bool (*is_of)(const JointDescription&);  ///< whether a joint has it; null: every owner has it
  SignalNeeds needs;
  SignalKind rate = SignalKind::kNone;  ///< its time derivative
  SignalShape shape = SignalShape::kScalar;
  SignalAxes axes = SignalAxes::kNone;
};

/// A quantity with its value, a function of a StateView and a SignalReference, in SI units. The
/// functions that a value calls are found where it is used, in elements/.
template <class Value>
struct SignalEntry {
  SignalFacts facts;
  Value value;
};
template <class Value>
constexpr SignalEntry<Value> signal_entry(const SignalFacts& facts, Value value) {
  return {facts, value};
}

// Which joints have a quantity.
bool has_coordinate(const JointDescription& joint);
bool has_actuator(const JointDescription& joint);
bool has_winding(const JointDescription& joint);
bool has_elastic_gear(const JointDescription& joint);
/// Whether a joint or loop has friction, from `<codesign:friction>`, `<dynamics friction>` or the
/// losses of its actuator.
bool has_friction(const JointDescription& joint);
/// Friction that is given in N m or N has no normal force.
bool has_normal_force(const JointDescription& joint);
bool has_gear_loss(const JointDescription& joint);
bool has_gear_torque(const JointDescription& joint);
bool is_movable(const JointDescription& joint);

namespace signal_table {

using K = SignalKind;
using Of = SignalOwner;
using Needs = SignalNeeds;
using Shape = SignalShape;
using Axes = SignalAxes;

/// Sets the kinds that rows leave open.
template <class... Values>
constexpr auto numbered(std::tuple<SignalEntry<Values>...> rows) {
  int k = 0;
  const auto number = [&k](SignalFacts* facts) {
    if (facts->kind == SignalKind::kNone) facts->kind = static_cast<SignalKind>(k);
    ++k;
    if (facts->rate == SignalKind::kNext) facts->rate = static_cast<SignalKind>(k);
  };
  std::apply([&number](auto&... row) { (number(&row.facts), ...); }, rows);
  return rows;
}

/// All quantities, in the order of SignalKind. A new one is a row here, with an enumerator if code
/// names it, and a line of doc/study/signals.md.
inline constexpr auto kRows = numbered(std::make_tuple(
    signal_entry({K::kJointPosition, Of::kJoint, "position", "q", has_coordinate, Needs::kMotion,
                  K::kJointVelocity},
                 [](const auto& view, const auto& of) {
                   return view.coordinate_value(of.pair, of.element);
                 }),
    signal_entry({K::kJointVelocity, Of::kJoint, "velocity", "q/s", has_coordinate, Needs::kMotion,
                  K::kJointAcceleration},
                 [](const auto& view, const auto& of) { return joint_rate(view, of); }),
    signal_entry(
        {K::kJointAcceleration, Of::kJoint, "acceleration", "q/s²", has_coordinate, Needs::kForces},
        [](const auto& view, const auto& of) { return joint_acceleration(view, of); }),
    signal_entry(
        {K::kJointEffort, Of::kJoint, "effort", "Q", has_coordinate, Needs::kEfforts},
        [](const auto& view, const auto& of) { return joint_effort(view, of.pair, of.element); }),
    signal_entry(
        {K::kJointEffortRate, Of::kJoint, "effort_rate", "Q/s", has_coordinate, Needs::kEfforts},
        [](const auto& view, const auto& of) { return joint_effort_rate(view, of); }),
    signal_entry(
        {K::kActuatorPower, Of::kJoint, "actuator_power", "W", has_coordinate, Needs::kEfforts},
        [](const auto& view, const auto& of) {
          return joint_power(view, PowerKind::kActuator, of.pair, of.element);
        }),
    signal_entry(
        {K::kDampingPower, Of::kJoint, "damping_power", "W", has_coordinate, Needs::kForces},
        [](const auto& view, const auto& of) {
          return joint_power(view, PowerKind::kDamping, of.pair, of.element);
        }),
    signal_entry({K::kLoadPower, Of::kJoint, "load_power", "W", has_coordinate, Needs::kForces},
                 [](const auto& view, const auto& of) {
                   return joint_power(view, PowerKind::kLoad, of.pair, of.element);
                 }),
    signal_entry(
        {K::kMotorTorque, Of::kJoint, "motor_torque", "N m", has_actuator, Needs::kEfforts},
        [](const auto& view, const auto& of) {
          return joint_effort(view, of.pair, of.element) / gear_ratio(view, of);
        }),
    signal_entry({K::kMotorSpeed, Of::kJoint, "motor_speed", "rad/s", has_actuator, Needs::kMotion,
                  K::kMotorAcceleration},
                 [](const auto& view, const auto& of) {
                   return gear_ratio(view, of) * joint_rate(view, motor_side(view, of));
                 }),
    signal_entry({K::kMotorPosition, Of::kJoint, "motor_position", "rad", has_actuator,
                  Needs::kMotion, K::kMotorSpeed},
                 [](const auto& view, const auto& of) { return motor_position(view, of); }),
    signal_entry({K::kCurrent, Of::kJoint, "current", "A", has_winding, Needs::kEfforts},
                 [](const auto& view, const auto& of) {
                   return of_motor(view, of, [](const auto& in, const auto& winding) {
                     return effective_current(in, winding);
                   });
                 }),
    signal_entry({K::kVoltage, Of::kJoint, "voltage", "V", has_winding, Needs::kEfforts},
                 [](const auto& view, const auto& of) {
                   return of_motor(view, of, [](const auto& in, const auto& winding) {
                     return terminal_voltage(in, winding);
                   });
                 }),
    signal_entry(
        {K::kElectricalPower, Of::kJoint, "electrical_power", "W", has_winding, Needs::kEfforts},
        [](const auto& view, const auto& of) {
          return of_motor(view, of, [](const auto& in, const auto& winding) {
            return electrical_power(in, winding);
          });
        }),
    signal_entry({K::kCopperLoss, Of::kJoint, "copper_loss", "W", has_winding, Needs::kEfforts},
                 [](const auto& view, const auto& of) {
                   return of_motor(view, of, [](const auto& in, const auto& winding) {
                     return copper_loss(in, winding);
                   });
                 }),
    signal_entry({K::kGearDeflection, Of::kJoint, "gear_deflection", "q", has_elastic_gear,
                  Needs::kMotion, K::kGearDeflectionRate},
                 [](const auto& view, const auto& of) { return gear_deflection_of(view, of); }),
    signal_entry({K::kJointFriction, Of::kJoint, "friction", "Q", has_friction, Needs::kReactions},
                 [](const auto& view, const auto& of) { return joint_friction(view, of); }),
    signal_entry({K::kJointNormalForce, Of::kJoint, "normal_force", "N", has_normal_force,
                  Needs::kReactions},
                 [](const auto& view, const auto& of) { return normal_force(view, of.pair); }),
    signal_entry({K::kJointSlidingVelocity, Of::kJoint, "sliding_velocity", "q/s", has_friction,
                  Needs::kForces, K::kJointAcceleration},
                 [](const auto& view, const auto& of) { return joint_rate(view, of); }),
    signal_entry(
        {K::kFrictionPower, Of::kJoint, "friction_power", "W", has_friction, Needs::kReactions},
        [](const auto& view, const auto& of) {
          return joint_power(view, PowerKind::kFriction, of.pair, of.element);
        }),
    signal_entry({K::kGearLoss, Of::kJoint, "gear_loss", "Q", has_gear_loss, Needs::kReactions},
                 [](const auto& view, const auto& of) { return joint_gear_loss(view, of); }),
    signal_entry(
        {K::kGearTorque, Of::kJoint, "gear_torque", "Q", has_gear_torque, Needs::kReactions},
        [](const auto& view, const auto& of) { return joint_gear_torque(view, of); }),
    signal_entry({K::kReactionForce, Of::kJoint, "reaction_force", "N", is_movable,
                  Needs::kReactions, K::kNone, Shape::kVector, Axes::kChildFrame},
                 [](const auto& view, const auto& of) { return reaction_term(view, of); }),
    signal_entry({K::kReactionTorque, Of::kJoint, "reaction_torque", "N m", is_movable,
                  Needs::kReactions, K::kNone, Shape::kVector, Axes::kChildFrame},
                 [](const auto& view, const auto& of) { return reaction_term(view, of); }),
    signal_entry(
        {K::kControllerError, Of::kController, "error", "e", nullptr, Needs::kControl,
         K::kControllerErrorRate},
        [](const auto& view, const auto& of) { return controller_error(view, of.controller); }),
    signal_entry(
        {K::kControllerSetpoint, Of::kController, "setpoint", "e", nullptr, Needs::kMotion,
         K::kControllerSetpointRate},
        [](const auto& view, const auto& of) { return controller_setpoint(view, of).value; }),
    signal_entry(
        {K::kControllerSetpointRate, Of::kController, "setpoint_rate", "e/s", nullptr,
         Needs::kMotion, K::kControllerSetpointAcceleration},
        [](const auto& view, const auto& of) { return controller_setpoint(view, of).rate; }),
    signal_entry({K::kControllerSetpointAcceleration, Of::kController, "setpoint_acceleration",
                  "e/s²", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return controller_setpoint(view, of).acceleration;
                 }),
    signal_entry({K::kControllerIntegral, Of::kController, "integral", "e s", nullptr,
                  Needs::kControl, K::kControllerError},
                 [](const auto& view, const auto& of) { return controller_integral(view, of); }),
    signal_entry(
        {K::kControllerOutput, Of::kController, "output", "Q", nullptr, Needs::kControl},
        [](const auto& view, const auto& of) { return controller_output(view, of.controller); }),
    signal_entry({K::kObservedPosition, Of::kController, "position", "q", nullptr, Needs::kControl},
                 [](const auto& view, const auto& of) { return estimate(view, of.controller, 0); }),
    signal_entry(
        {K::kObservedVelocity, Of::kController, "velocity", "q/s", nullptr, Needs::kControl},
        [](const auto& view, const auto& of) { return estimate(view, of.controller, 1); }),
    signal_entry(
        {K::kObservedDisturbance, Of::kController, "disturbance", "Q", nullptr, Needs::kControl},
        [](const auto& view, const auto& of) { return estimate(view, of.controller, 2); }),
    signal_entry({K::kLinkPosition, Of::kLink, "position", "m", nullptr, Needs::kMotion,
                  K::kLinkVelocity, Shape::kVector},
                 [](const auto& view, const auto& of) { return link_position(view, of); }),
    signal_entry({K::kLinkVelocity, Of::kLink, "velocity", "m/s", nullptr, Needs::kMotion,
                  K::kLinkAcceleration, Shape::kVector, Axes::kRootLink},
                 [](const auto& view, const auto& of) { return link_velocity(view, of); }),
    signal_entry({K::kLinkAcceleration, Of::kLink, "acceleration", "m/s²", nullptr, Needs::kForces,
                  K::kNone, Shape::kVector, Axes::kRootLink},
                 [](const auto& view, const auto& of) { return link_acceleration(view, of); }),
    signal_entry({K::kLinkAngularVelocity, Of::kLink, "angular_velocity", "rad/s", nullptr,
                  Needs::kMotion, K::kLinkAngularAcceleration, Shape::kVector, Axes::kRootLink},
                 [](const auto& view, const auto& of) { return link_angular_velocity(view, of); }),
    signal_entry(
        {K::kLinkAngularAcceleration, Of::kLink, "angular_acceleration", "rad/s²", nullptr,
         Needs::kForces, K::kNone, Shape::kVector, Axes::kRootLink},
        [](const auto& view, const auto& of) { return link_angular_acceleration(view, of); }),
    signal_entry({K::kLinkOrientation, Of::kLink, "orientation", "", nullptr, Needs::kMotion,
                  K::kNone, Shape::kQuaternion},
                 [](const auto& view, const auto& of) { return link_orientation(view, of); }),
    signal_entry({K::kImuAcceleration, Of::kLink, "imu_acceleration", "m/s²", nullptr,
                  Needs::kForces, K::kNone, Shape::kVector, Axes::kOwnLink},
                 [](const auto& view, const auto& of) { return imu_acceleration(view, of); }),
    signal_entry({K::kImuAngularVelocity, Of::kLink, "imu_angular_velocity", "rad/s", nullptr,
                  Needs::kMotion, K::kImuAngularAcceleration, Shape::kVector, Axes::kOwnLink},
                 [](const auto& view, const auto& of) { return link_angular_velocity(view, of); }),
    signal_entry(
        {K::kKineticEnergy, Of::kMechanism, "kinetic_energy", "J", nullptr, Needs::kMotion},
        [](const auto& view, const auto&) { return kinetic_energy(view); }),
    signal_entry(
        {K::kPotentialEnergy, Of::kMechanism, "potential_energy", "J", nullptr, Needs::kMotion},
        [](const auto& view, const auto&) { return potential_energy(view); }),
    signal_entry({K::kTotalEnergy, Of::kMechanism, "total_energy", "J", nullptr, Needs::kMotion},
                 [](const auto& view, const auto&) {
                   return kinetic_energy(view) + potential_energy(view);
                 }),
    signal_entry(
        {K::kTotalFrictionPower, Of::kMechanism, "friction_power", "W", nullptr, Needs::kReactions},
        [](const auto& view, const auto&) { return total_power(view, PowerKind::kFriction); }),
    signal_entry(
        {K::kTotalDampingPower, Of::kMechanism, "damping_power", "W", nullptr, Needs::kForces},
        [](const auto& view, const auto&) { return total_power(view, PowerKind::kDamping); }),
    signal_entry(
        {K::kTotalActuatorPower, Of::kMechanism, "actuator_power", "W", nullptr, Needs::kEfforts},
        [](const auto& view, const auto&) { return total_power(view, PowerKind::kActuator); }),
    signal_entry({K::kTotalLoadPower, Of::kMechanism, "load_power", "W", nullptr, Needs::kForces},
                 [](const auto& view, const auto&) { return total_power(view, PowerKind::kLoad); }),
    signal_entry({K::kTotalElectricalPower, Of::kMechanism, "electrical_power", "W", nullptr,
                  Needs::kEfforts},
                 [](const auto& view, const auto&) {
                   return sum_of_windings(view, [](const auto& in, const auto& winding) {
                     return electrical_power(in, winding);
                   });
                 }),
    signal_entry(
        {K::kTotalCopperLoss, Of::kMechanism, "copper_loss", "W", nullptr, Needs::kEfforts},
        [](const auto& view, const auto&) {
          return sum_of_windings(
              view, [](const auto& in, const auto& winding) { return copper_loss(in, winding); });
        }),
    signal_entry(
        {K::kMagneticEnergy, Of::kMechanism, "magnetic_energy", "J", nullptr, Needs::kEfforts},
        [](const auto& view, const auto&) {
          return sum_of_windings(view, [](const auto& in, const auto& winding) {
            return magnetic_energy(in, winding);
          });
        }),
    signal_entry({K::kShakingForce, Of::kMechanism, "shaking_force", "N", nullptr, Needs::kForces,
                  K::kNone, Shape::kVector, Axes::kRootLink},
                 [](const auto& view, const auto& of) { return shaking_force(view, of); }),
    signal_entry({K::kShakingMoment, Of::kMechanism, "shaking_moment", "N m", nullptr,
                  Needs::kForces, K::kNone, Shape::kVector, Axes::kRootLink},
                 [](const auto& view, const auto& of) { return shaking_moment(view, of); }),
    signal_entry({K::kMotorAcceleration, Of::kJoint, "", "", nullptr, Needs::kForces},
                 [](const auto& view, const auto& of) {
                   return gear_ratio(view, of) * joint_acceleration(view, motor_side(view, of));
                 }),
    signal_entry(
        {K::kGearDeflectionRate, Of::kJoint, "", "", nullptr, Needs::kMotion},
        [](const auto& view, const auto& of) { return gear_deflection_rate_of(view, of); }),
    signal_entry({K::kElasticTorque, Of::kJoint, "", "", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) { return elastic_torque_of(view, of); }),
    signal_entry(
        {K::kContactFriction, Of::kJoint, "", "", nullptr, Needs::kReactions},
        [](const auto& view, const auto& of) { return -contact_at(view, of.pair).magnitude(); }),
    signal_entry(
        {K::kContactSpeed, Of::kJoint, "", "", nullptr, Needs::kForces},
        [](const auto& view, const auto& of) { return contact_at(view, of.pair).speed(); }),
    signal_entry(
        {K::kImuAngularAcceleration, Of::kLink, "", "", nullptr, Needs::kForces, K::kNone,
         Shape::kVector, Axes::kOwnLink},
        [](const auto& view, const auto& of) { return link_angular_acceleration(view, of); }),
    signal_entry({K::kControllerErrorRate, Of::kController, "", "", nullptr, Needs::kForces},
                 [](const auto& view, const auto& of) {
                   return controller_error_rate(view, of.controller);
                 }),
    // Of elements between two links, theory (13b) and (13k) to (13m). A gap is that of the nearest
    // point of two shapes, negative by the penetration, as is the speed of slip; forces are those
    // of all points together.
    signal_entry({K::kNone, Of::kSpring, "force", "N", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return spring_at(view, to_index(of.link_element)).tension;
                 }),
    signal_entry({K::kNone, Of::kSpring, "length", "m", nullptr, Needs::kMotion, K::kNext},
                 [](const auto& view, const auto& of) {
                   return spring_at(view, to_index(of.link_element)).length;
                 }),
    signal_entry({K::kNone, Of::kSpring, "speed", "m/s", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return spring_speed(view, to_index(of.link_element));
                 }),
    signal_entry(
        {K::kNone, Of::kContact, "gap", "m", nullptr, Needs::kMotion, K::kNext},
        [](const auto& view, const auto& of) { return nearest_point(view, of.link_element).gap; }),
    signal_entry({K::kNone, Of::kContact, "gap_rate", "m/s", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return nearest_point(view, of.link_element).gap_rate;
                 }),
    signal_entry({K::kNone, Of::kContact, "normal_force", "N", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return contact_normal_force(view, of.link_element);
                 }),
    signal_entry(
        {K::kNone, Of::kContact, "friction", "N", nullptr, Needs::kMotion},
        [](const auto& view, const auto& of) { return contact_friction(view, of.link_element); }),
    signal_entry({K::kNone, Of::kContact, "sliding_speed", "m/s", nullptr, Needs::kMotion},
                 [](const auto& view, const auto& of) {
                   return contact_slip_speed(view, of.link_element);
                 })));

constexpr std::size_t kCount = std::tuple_size_v<decltype(kRows)>;

/// The facts alone.
inline constexpr auto kFacts = std::apply(
    [](const auto&... rows) { return std::array<SignalFacts, kCount>{rows.facts...}; }, kRows);

constexpr bool is_ordered() {
  for (std::size_t k = 0; k < kCount; ++k)
    if (kFacts[k].kind != static_cast<SignalKind>(k)) return false;
  return kCount > static_cast<std::size_t>(SignalKind::kControllerErrorRate);
}
static_assert(is_ordered(), "a row per SignalKind, in its order");

}  // namespace signal_table

constexpr const SignalFacts& facts_of(SignalKind kind) {
  return signal_table::kFacts[static_cast<std::size_t>(kind)];
}

/// The quantity of this name; null if the owner has none.
const SignalFacts* find_quantity(SignalOwner owner, const std::string& quantity);
/// Whether anything has a quantity of this name.
bool is_quantity(const std::string& quantity);

}  // namespace codesign
