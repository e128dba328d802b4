// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/signal.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "math/arrays.h"
#include "mechanism/signal_axes.h"
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

int axis_of(const std::string& component) {
  return component == "x" ? 0 : component == "y" ? 1 : 2;
}

SignalKind kind_of(SignalOwner owner, const SignalTerm& term) {
  return find_quantity(owner, term.quantity)->kind;
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
  reference.kind = kind_of(SignalOwner::kJoint, term);
  reference.pair = topology.joint_pair[to_index(joint)];
  if (reference.pair < 0)
    throw InputError(
        {signal.where, "signal",
         "the joint moves only a link without <inertial>, so it has no dynamics to read",
         signal.text, "a joint whose child link has an <inertial>"});
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

/// The link in whose axes a vector is told, SignalReference::axes.
int resolve_axes(const SignalTerm& term, const SignalReference& reference,
                 const SignalDescription& signal, const RobotDescription& robot,
                 const Topology& topology) {
  if (term.axes.empty())
    return facts_of(reference.kind).axes == SignalAxes::kOwnLink ? reference.link : -1;
  const int link = link_of_axes(term, robot);
  if (link == robot.root && facts_of(reference.kind).axes == SignalAxes::kRootLink) return -1;
  if (topology.link_body[to_index(link)] == Topology::kMassless)
    throw InputError({signal.where, "signal",
                      "the link behind the @ has no <inertial>, so it is folded into a joint and "
                      "its axes cannot be read",
                      signal.text, "a link with an <inertial>, or @ground"});
  return link;
}

SignalReference resolve_link(const SignalTerm& term, int link, const SignalDescription& signal,
                             const Topology& topology) {
  SignalReference reference;
  reference.link = link;
  reference.axis = axis_of(term.component);
  reference.kind = kind_of(SignalOwner::kLink, term);
  if (reference.kind == SignalKind::kLinkOrientation)
    reference.axis = term.component == "w" ? 0 : 1 + axis_of(term.component);
  if (topology.link_body[to_index(link)] == Topology::kMassless)
    throw InputError({signal.where, "signal",
                      "the link has no <inertial>, so it is folded into a joint and cannot be read",
                      signal.text, "a link with an <inertial>"});
  return reference;
}

/// The variables of an expression: its signals in the order of the terms, parameters, the time.
std::shared_ptr<const ResolvedFormula> resolve_formula(const SignalDescription& signal,
                                                       const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size() + 1);
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  ResolvedFormula formula{signal.formula->steps, {}, signal.formula->text};
  int terms = 0;
  for (const std::string& name : signal.formula->names) {
    ResolvedFormula::Variable& variable = formula.variables.emplace_back();
    if (name.find('/') != std::string::npos) {
      variable.term = terms++;
    } else if (signal.text == kEndTime) {
      continue;
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
      reference.kind = kind_of(SignalOwner::kMechanism, term);
      reference.axis = axis_of(term.component);
    } else if (const auto element = find_link_element(term, robot)) {
      reference.kind = kind_of(element->kind, term);
      reference.link_element = element->index;
    } else if (const auto controller = find_named(controllers, term.object)) {
      reference.kind = kind_of(SignalOwner::kController, term);
      reference.controller = *controller;
    } else if (const auto joint = find_named(robot.joints, term.object);
               joint && (term.component.empty() || is_reaction(term))) {
      reference = resolve_joint(term, *joint, signal, robot, topology);
    } else {
      reference =
          resolve_link(term, find_named(robot.links, term.object).value(), signal, topology);
    }
    reference.axes = resolve_axes(term, reference, signal, robot, topology);
    reference.factor = term.factor;
    resolved.push_back(reference);
  }
  return resolved;
}

bool reads_time(const Signal& signal) {
  if (!signal.formula) return false;
  const auto is_time = [](const ResolvedFormula::Variable& variable) {
    return variable.term < 0 && !variable.parameter;
  };
  return std::any_of(signal.formula->variables.begin(), signal.formula->variables.end(), is_time);
}

std::optional<Signal> differentiate(const Signal& resolved) {
  if (resolved.is_rate) return std::nullopt;
  Signal derivative = resolved;
  for (SignalReference& reference : derivative) {
    reference.kind = facts_of(reference.kind).rate;
    if (reference.kind == SignalKind::kNone) return std::nullopt;
    // Axes that turn add to the rate of what is told in them, but to that of their own angular
    // velocity.
    const bool turns_itself = reference.axes == reference.link &&
                              (reference.kind == SignalKind::kLinkAngularAcceleration ||
                               reference.kind == SignalKind::kImuAngularAcceleration);
    if (reference.axes >= 0 && !turns_itself) return std::nullopt;
  }
  if (!resolved.formula) return derivative;
  derivative.insert(derivative.begin(), resolved.begin(), resolved.end());
  derivative.is_rate = true;
  return derivative;
}

Signal differentiate(const Signal& resolved, const SignalDescription& signal,
                     const std::string& element) {
  std::optional<Signal> derivative = differentiate(resolved);
  if (!derivative)
    throw InputError({signal.where, element, "the time derivative of this signal is not available",
                      signal.text,
                      "sums and expressions of joint or link positions and velocities"});
  return std::move(*derivative);
}

}  // namespace codesign
