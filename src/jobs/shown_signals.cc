// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/shown_signals.h"

#include <algorithm>

#include "description/study.h"
#include "jobs/json.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

template <class Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

/// The unit of a quantity, SignalFacts::unit. @param joint whose coordinate it is; null: none.
/// @param input unit of the input of the controller whose quantity it is.
std::string unit_of(const SignalFacts& facts, const JointDescription* joint,
                    const std::string& input) {
  std::string unit = facts.unit;
  if (unit.empty()) return "";
  if (unit.front() == 'e') return input + unit.substr(1);
  if (unit.front() != 'q' && unit.front() != 'Q') return unit;
  if (facts.kind == SignalKind::kControllerOutput && joint != nullptr && joint->has_winding())
    return "V";
  if (joint == nullptr) return "";
  // Friction of a cylindrical joint is that of its turn.
  const bool turns = joint->freedoms().turns > 0 &&
                     (joint->freedoms().slides == 0 || joint->law().slip_coordinates == 0);
  const char* of_joint = unit.front() == 'q' ? (turns ? "rad" : "m") : (turns ? "N m" : "N");
  return of_joint + unit.substr(1);
}

/// Adds the limits of a joint that apply to one of its signals.
void add_limits(const RobotDescription& robot, const std::vector<double>& parameters,
                ShownSignal* shown) {
  const SignalTerm* only = shown->signal.only_term();
  if (!only) return;
  const SignalTerm& term = *only;
  const JointDescription* joint = find_named(robot.joints, term.object);
  if (joint == nullptr || !joint->limit) return;
  const LimitDescription& limit = *joint->limit;
  const auto set = [&](const Quantity& lower, double factor, const Quantity& upper) {
    shown->lower = factor * lower.at(parameters);
    shown->upper = upper.at(parameters);
  };
  if (term.quantity == "position" && has_stops(*joint)) set(limit.lower, 1.0, limit.upper);
  if (term.quantity == "velocity" && limit.bounds_velocity())
    set(limit.velocity, -1.0, limit.velocity);
  if (term.quantity == "effort" && limit.bounds_effort()) set(limit.effort, -1.0, limit.effort);
}

/// Candidates beyond default_signals(); some of them do not exist in every mechanism.
std::vector<std::string> further_signals(const RobotDescription& robot, const MotionStudy& study) {
  std::vector<std::string> texts;
  for (const ControllerDescription& controller : study.controllers) {
    if (!controller.output.empty()) texts.push_back(controller.output + "/effort");
    if (controller.kind->has_error())
      for (const char* quantity : {"/setpoint", "/error"})
        texts.push_back(controller.name + quantity);
    if (controller.kind->input != ControlInput::kObserved) continue;
    for (const char* quantity : {"/position", "/velocity", "/disturbance"})
      texts.push_back(controller.name + quantity);
  }
  for (const GivenMotion& motion : study.motion) texts.push_back(motion.joint + "/effort");
  for (const JointDescription& joint : robot.joints)
    if (has_friction(joint) && joint.has_one_coordinate())
      texts.push_back(joint.name + "/friction_power");
  const std::size_t before = texts.size();
  for (const JointDescription& joint : robot.joints)
    if (joint.has_winding())
      for (const char* quantity : {"/current", "/voltage"}) texts.push_back(joint.name + quantity);
  if (texts.size() > before)
    for (const char* quantity : {"electrical_power", "copper_loss"})
      texts.push_back(std::string("mechanism/") + quantity);
  for (const char* quantity : {"friction_power", "damping_power", "actuator_power", "load_power"})
    texts.push_back(std::string("mechanism/") + quantity);
  return texts;
}

/// Whether a signal exists and is not ambiguous, such as a power of a joint with the name
/// `mechanism`.
bool exists(const SignalDescription& signal, const RobotDescription& robot,
            const std::vector<ControllerDescription>& controllers) {
  try {
    check_signal(signal, robot, controllers, "");
  } catch (const InputError&) {
    return false;
  }
  return true;
}

Json place(const ScenarioResult& scenario) {
  return {{"run", scenario.run}, {"sample", scenario.sample + 1}};
}

}  // namespace

std::string unit_of(const SignalDescription& signal, const RobotDescription& robot,
                    const std::vector<ControllerDescription>& controllers) {
  if (signal.formula) return "";
  const SignalTerm& term = signal.terms.front();
  if (is_of_mechanism(term)) return find_quantity(SignalOwner::kMechanism, term.quantity)->unit;
  if (const auto element = find_link_element(term, robot))
    return find_quantity(element->kind, term.quantity)->unit;
  if (const ControllerDescription* controller = find_named(controllers, term.object)) {
    const SignalFacts* facts = find_quantity(SignalOwner::kController, term.quantity);
    const bool observes = controller->kind->input == ControlInput::kObserved;
    return unit_of(
        *facts,
        find_named(robot.joints, observes ? controller->observer.joint : controller->output),
        term.quantity == "output" || controller->input.terms.empty()
            ? ""
            : unit_of(controller->input, robot, controllers));
  }
  // A joint and a link may share a name; only a joint's reactions have components, too.
  const JointDescription* joint = find_named(robot.joints, term.object);
  if (joint != nullptr && (term.component.empty() || is_reaction(term)))
    return unit_of(*find_quantity(SignalOwner::kJoint, term.quantity), joint, "");
  return find_quantity(SignalOwner::kLink, term.quantity)->unit;
}

std::vector<ShownSignal> shown_signals(const Problem& problem,
                                       const std::vector<double>& parameters) {
  const RobotDescription& robot = robot_of(problem);
  const std::vector<ControllerDescription>& controllers = study_of(problem).controllers;
  std::vector<ShownSignal> shown;
  const auto add = [&](const SignalDescription& signal) {
    const auto is_same = [&signal](const ShownSignal& other) {
      return other.signal.text == signal.text;
    };
    if (std::any_of(shown.begin(), shown.end(), is_same) || !exists(signal, robot, controllers))
      return;
    shown.push_back({signal, unit_of(signal, robot, controllers), {}, {}});
    add_limits(robot, parameters, &shown.back());
  };
  std::vector<std::string> texts = default_signals(robot, controllers);
  for (const std::string& text : further_signals(robot, study_of(problem))) texts.push_back(text);
  for (const std::string& text : texts) add(parse_signal(text, {}, ""));
  for (const SignalDescription& signal : signals_of(study_of(problem))) add(signal);
  return shown;
}

void add_watched(const OptimizationResult& result, Json* object) {
  if (result.constraints.watched.empty()) return;
  Json list = Json::array();
  for (const WatchedResult& watched : result.constraints.watched) {
    Json one = record_json(watched);
    if (!result.ensemble.scenarios.empty()) {
      one["smallest_in"] = place(result.ensemble.scenarios[to_index(watched.smallest_scenario)]);
      one["largest_in"] = place(result.ensemble.scenarios[to_index(watched.largest_scenario)]);
    }
    list.push_back(std::move(one));
  }
  (*object)["signals"] = std::move(list);
}

}  // namespace codesign
