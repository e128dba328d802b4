// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/signal.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "mechanism/topology.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

template <class Items>
std::optional<int> find_named(const Items& items, const std::string& name) {
  for (std::size_t k = 0; k < items.size(); ++k)
    if (items[k].name == name) return static_cast<int>(k);
  return std::nullopt;
}

const std::map<std::string, SignalKind>& joint_kinds() {
  static const std::map<std::string, SignalKind> kinds{
      {"position", SignalKind::kJointPosition},
      {"velocity", SignalKind::kJointVelocity},
      {"acceleration", SignalKind::kJointAcceleration},
      {"effort", SignalKind::kJointEffort},
      {"effort_rate", SignalKind::kJointEffortRate},
      {"friction", SignalKind::kJointFriction},
      {"gear_torque", SignalKind::kGearTorque},
      {"gear_loss", SignalKind::kGearLoss},
      {"normal_force", SignalKind::kJointNormalForce},
      {"sliding_velocity", SignalKind::kJointSlidingVelocity},
      {"friction_power", SignalKind::kFrictionPower},
      {"damping_power", SignalKind::kDampingPower},
      {"actuator_power", SignalKind::kActuatorPower},
      {"load_power", SignalKind::kLoadPower},
      {"motor_torque", SignalKind::kMotorTorque},
      {"motor_speed", SignalKind::kMotorSpeed},
      {"motor_position", SignalKind::kMotorPosition},
      {"gear_deflection", SignalKind::kGearDeflection},
      {"reaction_force", SignalKind::kReactionForce},
      {"reaction_torque", SignalKind::kReactionTorque}};
  return kinds;
}

int axis_of(const std::string& component) {
  return component == "x" ? 0 : component == "y" ? 1 : 2;
}

const std::map<std::string, SignalKind>& mechanism_kinds() {
  static const std::map<std::string, SignalKind> kinds{
      {"kinetic_energy", SignalKind::kKineticEnergy},
      {"potential_energy", SignalKind::kPotentialEnergy},
      {"total_energy", SignalKind::kTotalEnergy},
      {"friction_power", SignalKind::kFrictionPower},
      {"damping_power", SignalKind::kDampingPower},
      {"actuator_power", SignalKind::kActuatorPower},
      {"load_power", SignalKind::kLoadPower}};
  return kinds;
}

/// Throws InputError: the child of the joint has no mass and transmits the reaction to the next
/// joint, where it can be read.
[[noreturn]] void refuse_reaction(const SignalTerm& term, const Pair& pair,
                                  const SignalDescription& signal, const RobotDescription& robot,
                                  const Topology& topology) {
  std::string allowed;
  for (const ChainElement& element : pair.chain) {
    const JointDescription& other = robot.joints[to_index(element.joint)];
    if (topology.link_body[to_index(other.child)] == Topology::kMassless) continue;
    allowed =
        other.name + "/" + term.quantity + "/" + term.component + ", in the frame of that joint";
  }
  throw InputError({signal.where, "signal",
                    "the joint's child has no <inertial>: the joint is folded with the next one, "
                    "where the reaction can be read",
                    signal.text, allowed});
}

SignalReference resolve_joint(const SignalTerm& term, int joint, const SignalDescription& signal,
                              const RobotDescription& robot, const Topology& topology) {
  SignalReference reference;
  reference.kind = joint_kinds().at(term.quantity);
  reference.pair = topology.joint_pair[to_index(joint)];
  if (reference.pair < 0)
    throw InputError(
        {signal.where, "signal",
         "the joint moves only a link without <inertial>, so it has no dynamics to read",
         signal.text, ""});
  const Pair& pair = topology.pairs[to_index(reference.pair)];
  for (std::size_t k = 0; k < pair.chain.size(); ++k)
    if (pair.chain[k].joint == joint) reference.element = static_cast<int>(k);
  if (reference.kind == SignalKind::kGearTorque && robot.joints[to_index(joint)].motor >= 0)
    reference.kind = SignalKind::kElasticTorque;
  if (is_reaction(term)) {
    reference.axis = axis_of(term.component);
    const int child = robot.joints[to_index(joint)].child;
    if (topology.link_body[to_index(child)] == Topology::kMassless)
      refuse_reaction(term, pair, signal, robot, topology);
  }
  if (pair.friction_joint != joint || !slips_isotropically(pair.kind)) return reference;
  if (reference.kind == SignalKind::kJointFriction) reference.kind = SignalKind::kContactFriction;
  if (reference.kind == SignalKind::kJointSlidingVelocity)
    reference.kind = SignalKind::kContactSpeed;
  return reference;
}

SignalReference resolve_link(const SignalTerm& term, int link, const SignalDescription& signal,
                             const Topology& topology) {
  SignalReference reference;
  reference.link = link;
  reference.axis = axis_of(term.component);
  reference.kind = term.quantity == "position"      ? SignalKind::kLinkPosition
                   : term.quantity == "velocity"    ? SignalKind::kLinkVelocity
                   : term.quantity == "orientation" ? SignalKind::kLinkOrientation
                                                    : SignalKind::kLinkAngularVelocity;
  if (reference.kind == SignalKind::kLinkOrientation)
    reference.axis = term.component == "w" ? 0 : 1 + axis_of(term.component);
  if (topology.link_body[to_index(link)] == Topology::kMassless)
    throw InputError({signal.where, "signal",
                      "the link has no <inertial>, so it is folded into a joint and cannot be read",
                      signal.text, ""});
  return reference;
}

SignalReference resolve_controller(const SignalTerm& term, int controller) {
  SignalReference reference;
  reference.controller = controller;
  reference.kind = term.quantity == "error"      ? SignalKind::kControllerError
                   : term.quantity == "setpoint" ? SignalKind::kControllerSetpoint
                   : term.quantity == "integral" ? SignalKind::kControllerIntegral
                                                 : SignalKind::kControllerOutput;
  return reference;
}

SignalReference resolve_spring(const SignalTerm& term, int spring) {
  SignalReference reference;
  reference.spring = spring;
  reference.kind = term.quantity == "force"    ? SignalKind::kSpringForce
                   : term.quantity == "length" ? SignalKind::kSpringLength
                                               : SignalKind::kSpringSpeed;
  return reference;
}

/// The variables of an expression: its signals in the order of the terms, parameters, the time.
std::shared_ptr<const ResolvedFormula> resolve_formula(const SignalDescription& signal,
                                                       const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size() + 1);
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  ResolvedFormula formula{signal.formula->steps, {}};
  int terms = 0;
  for (const std::string& name : signal.formula->names) {
    ResolvedFormula::Variable& variable = formula.variables.emplace_back();
    if (name.find('/') != std::string::npos) {
      variable.term = terms++;
    } else if (std::find(names.begin(), names.end(), name) != names.end()) {
      variable.parameter = std::make_shared<const Expression>(name, names);
    } else if (name != "t") {
      names.emplace_back("t");
      InputFault fault = unknown_name(signal.where, "signal", "parameter", name, names).fault();
      fault.value = signal.text;
      fault.allowed += "; signals are written NAME/QUANTITY, without spaces";
      throw InputError(fault);
    }
  }
  return std::make_shared<const ResolvedFormula>(std::move(formula));
}

std::optional<SignalKind> derivative_kind(SignalKind kind) {
  switch (kind) {
    case SignalKind::kJointPosition:
      return SignalKind::kJointVelocity;
    case SignalKind::kJointVelocity:
    case SignalKind::kJointSlidingVelocity:
      return SignalKind::kJointAcceleration;
    case SignalKind::kMotorPosition:
      return SignalKind::kMotorSpeed;
    case SignalKind::kMotorSpeed:
      return SignalKind::kMotorAcceleration;
    case SignalKind::kGearDeflection:
      return SignalKind::kGearDeflectionRate;
    case SignalKind::kLinkPosition:
      return SignalKind::kLinkVelocity;
    case SignalKind::kLinkVelocity:
      return SignalKind::kLinkAcceleration;
    case SignalKind::kSpringLength:
      return SignalKind::kSpringSpeed;
    case SignalKind::kControllerIntegral:
      return SignalKind::kControllerError;
    case SignalKind::kControllerError:
      return SignalKind::kControllerErrorRate;
    case SignalKind::kControllerSetpoint:
      return SignalKind::kControllerSetpointRate;
    default:
      return std::nullopt;
  }
}

}  // namespace

Signal resolve_signal(const SignalDescription& signal, const RobotDescription& robot,
                      const Topology& topology,
                      const std::vector<ControllerDescription>& controllers,
                      const std::vector<Parameter>& parameters) {
  check_signal(signal, robot, controllers, "signal");
  Signal resolved;
  if (signal.formula) resolved.formula = resolve_formula(signal, parameters);
  for (const SignalTerm& term : signal.terms) {
    SignalReference reference;
    if (is_of_mechanism(term)) {
      reference.kind = mechanism_kinds().at(term.quantity);
    } else if (const auto spring = find_named(robot.spring_dampers, term.object);
               spring && is_of_spring(term)) {
      reference = resolve_spring(term, *spring);
    } else if (const auto controller = find_named(controllers, term.object)) {
      reference = resolve_controller(term, *controller);
    } else if (const auto joint = find_named(robot.joints, term.object);
               joint && (term.component.empty() || is_reaction(term))) {
      reference = resolve_joint(term, *joint, signal, robot, topology);
    } else {
      reference =
          resolve_link(term, find_named(robot.links, term.object).value(), signal, topology);
    }
    reference.factor = term.factor;
    resolved.push_back(reference);
  }
  return resolved;
}

bool is_of_motion(SignalKind kind) {
  switch (kind) {
    case SignalKind::kJointPosition:
    case SignalKind::kJointVelocity:
    case SignalKind::kLinkPosition:
    case SignalKind::kLinkVelocity:
    case SignalKind::kLinkAngularVelocity:
    case SignalKind::kLinkOrientation:
    case SignalKind::kKineticEnergy:
    case SignalKind::kPotentialEnergy:
    case SignalKind::kTotalEnergy:
    case SignalKind::kSpringForce:
    case SignalKind::kSpringLength:
    case SignalKind::kSpringSpeed:
    case SignalKind::kMotorSpeed:
    case SignalKind::kMotorPosition:
    case SignalKind::kGearDeflection:
    case SignalKind::kGearDeflectionRate:
    case SignalKind::kElasticTorque:
    case SignalKind::kControllerSetpoint:
      return true;
    default:
      return false;
  }
}

bool reads_time(const Signal& signal) {
  if (!signal.formula) return false;
  const auto is_time = [](const ResolvedFormula::Variable& variable) {
    return variable.term < 0 && !variable.parameter;
  };
  return std::any_of(signal.formula->variables.begin(), signal.formula->variables.end(), is_time);
}

std::optional<Signal> differentiate(const Signal& resolved) {
  if (resolved.formula) return std::nullopt;
  Signal derivative = resolved;
  for (SignalReference& reference : derivative) {
    const auto kind = derivative_kind(reference.kind);
    if (!kind) return std::nullopt;
    reference.kind = *kind;
  }
  return derivative;
}

Signal differentiate(const Signal& resolved, const SignalDescription& signal,
                     const std::string& element) {
  std::optional<Signal> derivative = differentiate(resolved);
  if (!derivative)
    throw InputError({signal.where, element, "the time derivative of this signal is not available",
                      signal.text, "sums of joint or link positions and velocities"});
  return std::move(*derivative);
}

}  // namespace codesign
