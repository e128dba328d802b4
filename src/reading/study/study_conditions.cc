// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "description/expression_syntax.h"
#include "math/scalar.h"
#include "mechanism/signal_catalog.h"
#include "reading/study/entry_keys.h"
#include "reading/study/signal_table.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// Whether friction of a joint has states that can hold it. Behind an elastic gear the flanks do
/// not: its spring starts undeflected and carries nothing.
bool can_stick(const JointDescription& joint) {
  return (joint.friction && joint.friction->model->bristle) ||
         (joint.actuator && joint.actuator->gear && !joint.actuator->elastic &&
          joint.actuator->gear->slip.model->bristle);
}

/// The joint or loop of this name, whose initial state may be given.
const JointDescription& starting_joint(const std::string& name, const RobotDescription& robot,
                                       const YamlValue& value) {
  std::vector<std::string> known;
  for (const JointDescription& joint : robot.joints) {
    const bool free = joint.has_pose();
    if (joint.name == name && (free || joint.has_one_coordinate() || can_stick(joint)))
      return joint;
    if (joint.name == name)
      value.fail(
          "this joint has neither a single coordinate nor a pose",
          "a revolute, continuous, prismatic, planar, spherical, cylindrical or floating joint");
    if (free || joint.has_one_coordinate()) known.push_back(joint.name);
  }
  throw unknown_name(value.where(), value.path(), "joint", name, known);
}

/// Checks that a joint can slide along a vector, at the parameters' start values: in the plane
/// normal to its axis, or along the axis.
void check_slide(const YamlValue& value, const QuantityVector& vector,
                 const JointDescription& joint) {
  if (joint.freedoms().slides == 0)
    value.fail("this joint does not slide", "rotation, angular_velocity");
  const auto nominal = [](const QuantityVector& q) {
    return Vector3<double>(q[0].nominal(), q[1].nominal(), q[2].nominal());
  };
  const Vector3<double> x = nominal(vector), axis = nominal(joint.axis).normalized();
  const double along = x.dot(axis), across = (x - along * axis).norm(),
               allowed = 1e-9 * (1.0 + x.norm());
  if (joint.freedoms().slides == 2 && std::abs(along) > allowed)
    value.fail(
        "the vector does not lie in the plane of the joint; its component along the normal is " +
            to_decimal(along),
        "a vector normal to the joint's <axis>");
  if (joint.freedoms().slides == 1 && across > allowed)
    value.fail("the vector does not lie along the axis of the joint; its component across it is " +
                   to_decimal(across),
               "a vector along the joint's <axis>");
}

/// What the start of a joint is read with.
struct StartContext {
  const JointDescription& joint;
  const ParameterTable& table;
};
using StartKeys = EntryKeys<InitialJointState, StartContext>;
using StartKey = EntryKey<InitialJointState, StartContext>;

/// The joint is at rest, held by its bristles.
void read_stuck(const YamlValue& value, const StartContext& in, InitialJointState* state) {
  const JointDescription& joint = in.joint;
  if (!value.boolean()) return;
  if (!can_stick(joint)) {
    if (joint.actuator && joint.actuator->elastic && joint.actuator->gear &&
        joint.actuator->gear->slip.model->bristle)
      value.fail(
          "the gear of the joint is elastic and starts undeflected, so that friction of its flanks "
          "does not hold the joint",
          "friction with states at the joint itself, or a gear without stiffness");
    value.fail("the joint has no friction with states, which alone can hold it at rest",
               "model=\"lugre\" or \"gonthier\" in its <codesign:friction>, or model=\"lugre\" "
               "in its <codesign:actuator>");
  }
  if (state->velocity || state->linear_velocity || state->angular_velocity)
    value.fail("a joint that starts stuck is at rest, and its velocity is given, too",
               "either stuck or a velocity");
  state->stuck = true;
  if (joint.is_loop) return;
  if (joint.has_pose())
    state->linear_velocity.emplace(), state->angular_velocity.emplace();
  else
    state->velocity = Quantity(0.0);
}

StartKey scalar_key(const char* name, std::optional<Quantity> InitialJointState::*member) {
  return {name, false,
          [member](const YamlValue& value, const StartContext& in, InitialJointState* state) {
            state->*member = read_quantity(value, in.table);
          }};
}

const StartKeys& scalar_keys() {
  static const StartKeys kKeys{
      scalar_key("position", &InitialJointState::position),
      scalar_key("velocity", &InitialJointState::velocity),
      {"guess", false, [](const YamlValue& value, const StartContext&, InitialJointState* state) {
         if (state->position)
           value.fail("a joint has either a position or a guess of it",
                      "position, which is kept, or guess, where the search for a closed loop "
                      "begins");
         state->guess = value.number();
       }}};
  return kKeys;
}

StartKey slide_key(const char* name, std::optional<QuantityVector> InitialJointState::*member) {
  return {name, false,
          [member](const YamlValue& value, const StartContext& in, InitialJointState* state) {
            state->*member = read_vector(value, in.table);
            check_slide(value, *(state->*member), in.joint);
          }};
}

StartKey turn_key(const char* name, std::optional<QuantityVector> InitialJointState::*member) {
  return {name, false,
          [member](const YamlValue& value, const StartContext& in, InitialJointState* state) {
            const bool turns_once = in.joint.freedoms().turns == 1;
            if (turns_once && value.is_list())
              value.fail(in.joint.freedoms().slides == 2
                             ? "a planar joint turns only about its normal"
                             : "this joint turns only about its axis",
                         "one number");
            state->*member = turns_once ? QuantityVector{0.0, 0.0, read_quantity(value, in.table)}
                                        : read_vector(value, in.table);
          }};
}

const StartKeys& pose_keys() {
  static const StartKeys kKeys{slide_key("translation", &InitialJointState::translation),
                               turn_key("rotation", &InitialJointState::rotation),
                               slide_key("linear_velocity", &InitialJointState::linear_velocity),
                               turn_key("angular_velocity", &InitialJointState::angular_velocity)};
  return kKeys;
}

StartKeys with_stuck(const StartKeys& keys) {
  return with(keys, StartKeys{{"stuck", false, read_stuck}});
}

std::string list_keys(const StartKeys& keys) {
  std::vector<std::string> names;
  for (const StartKey& key : keys) names.emplace_back(key.name);
  return list_names(names);
}

/// Of the winding of the joint's motor.
StartKey current_key() {
  return {"current", false,
          [](const YamlValue& value, const StartContext& in, InitialJointState* state) {
            if (!in.joint.has_winding() || !in.joint.actuator->winding->has_state())
              value.fail(
                  "the motor of the joint has no inductance, so that its current does not start: "
                  "it follows from the voltage",
                  "an inductance in its <codesign:actuator>");
            state->current = read_quantity(value, in.table);
          }};
}

InitialJointState read_joint_start(const std::string& name, const YamlValue& value,
                                   const RobotDescription& robot, const ParameterTable& table) {
  const JointDescription& joint = starting_joint(name, robot, value);
  const bool pose = joint.has_pose(), scalar = joint.has_one_coordinate();
  StartKeys keys = with_stuck(pose ? pose_keys() : scalar ? scalar_keys() : StartKeys());
  if (joint.has_winding()) keys.push_back(current_key());
  if (value.is_map())
    for (const StartKey& other : pose ? scalar_keys() : pose_keys())
      if (const auto at = value.find(other.name))
        at->fail(std::string("this joint's start has no ") + other.name, list_keys(keys));
  InitialJointState state;
  state.joint = joint.name;
  state.where = value.where();
  read_entry(value, keys, StartContext{joint, table}, &state);
  if (value.entries().empty())
    value.fail("no initial state is given for this joint", list_keys(keys));
  // An angular velocity needs a known rotation: zero if it is not given.
  if (value.find("angular_velocity") && !state.rotation) state.rotation.emplace();
  return state;
}

}  // namespace

std::vector<EntryForm> forms_of_starts() {
  return {{"initial_state.JOINT", with(with_stuck(scalar_keys()), StartKeys{current_key()})},
          {"initial_state.JOINT", with_stuck(pose_keys())}};
}

void read_initial_state(const YamlValue& study_value, const RobotDescription& robot,
                        const ParameterTable& table, Study* study) {
  const auto initial_state = study_value.find("initial_state");
  if (!initial_state) return;
  for (const auto& [name, value] : initial_state->entries()) {
    study->initial_state.push_back(read_joint_start(name, value, robot, table));
    if (!study->initial_state.back().stuck) continue;
    for (const char* key : {"positions", "identify"})
      if (study_value.find(key))
        value.at("stuck").fail(
            std::string("a study with ") + key + " has no start of a run that friction could hold",
            std::string("either stuck or ") + key);
  }
}

namespace {

bool is_table(const YamlValue& value) {
  if (!value.is_map()) return false;
  const auto type = value.find("type");
  return type && type->text() == "table";
}

/// Refuses the first word that follows the name of a joint, link or controller and a slash.
void refuse_unknown_quantity(const YamlValue& value, const EntryContext& in) {
  const std::string text = value.text();
  const auto check = [&](const std::string& name) {
    const std::size_t at = text.find(name + "/"), word = at + name.size() + 1;
    if (at == std::string::npos || in.table.index.count(name) > 0) return;
    if (continues_identifier(text[at - 1])) return;
    std::size_t end = word;
    while (end < text.size() && continues_identifier(text[end])) ++end;
    if (end == word) return;
    const std::string quantity = text.substr(word, end - word);
    check_signal({name + "/" + quantity, {{1.0, name, quantity, ""}}, value.where(), nullptr},
                 in.robot, in.study.controllers, value.path());
  };
  for (const JointDescription& joint : in.robot.joints) check(joint.name);
  for (const LinkDescription& link : in.robot.links) check(link.name);
  for (const ControllerDescription& controller : in.study.controllers) check(controller.name);
}

/// A function of time. In `${2*elbow/positon}` the word after the joint is no quantity, so that
/// there is no signal: the error shall tell that, not that `elbow` is no parameter.
ReferenceDescription read_of_time(const YamlValue& value, const EntryContext& in) {
  try {
    return read_reference(value, in.table, in.loader);
  } catch (const InputError&) {
    if (!value.is_map() && is_expression(value.text())) refuse_unknown_quantity(value, in);
    throw;
  }
}

LoadFunction read_function(const YamlValue& value, const EntryContext& in) {
  LoadFunction function;
  SignalDescription signal;
  if (is_table(value))
    signal = read_signal_table(value, in.table);
  else if (!value.is_map() && is_expression(value.text()))
    signal = parse_signal(value.text(), value.where(), value.path());
  if (signal.terms.empty()) {
    function.of_time = read_of_time(value, in);
    return function;
  }
  check_signal(signal, in.robot, in.study.controllers, value.path());
  use_parameters(signal, in.table);
  function.of_signals = std::make_shared<const SignalDescription>(std::move(signal));
  return function;
}

using Components = std::array<LoadFunction, 3>;

EntryKey<LoadDescription> components_key(const char* name, Components LoadDescription::*member) {
  return {name, false,
          [member](const YamlValue& value, const EntryContext& in, LoadDescription* load) {
            if (!value.is_list()) value.fail("three components are needed", "[x, y, z]");
            const std::vector<YamlValue> items = value.items();
            if (items.size() != 3)
              value.fail("three components are needed, found " + std::to_string(items.size()),
                         "[x, y, z]");
            for (std::size_t k = 0; k < 3; ++k) (load->*member)[k] = read_function(items[k], in);
          }};
}

const EntryKeys<LoadDescription>& effort_keys() {
  static const EntryKeys<LoadDescription> kKeys{
      required_key<LoadDescription>(
          "joint",
          [](const YamlValue& value, const EntryContext& in, LoadDescription* load) {
            load->joint = scalar_joint(value.text(), in.robot, value).name;
          }),
      required_key<LoadDescription>(
          "effort", [](const YamlValue& value, const EntryContext& in, LoadDescription* load) {
            load->effort = read_function(value, in);
          })};
  return kKeys;
}

const EntryKeys<LoadDescription>& wrench_keys() {
  static const EntryKeys<LoadDescription> kKeys{
      required_key<LoadDescription>(
          "link",
          [](const YamlValue& value, const EntryContext& in, LoadDescription* load) {
            std::vector<std::string> known;
            for (const LinkDescription& link : in.robot.links) known.push_back(link.name);
            load->link = value.choice("link", known);
          }),
      components_key("force", &LoadDescription::force),
      components_key("torque", &LoadDescription::torque),
      optional_key<LoadDescription>(
          "point", [](const YamlValue& value, const EntryContext& in,
                      LoadDescription* load) { load->point = read_vector(value, in.table); }),
      optional_key<LoadDescription>(
          "frame", [](const YamlValue& value, const EntryContext&, LoadDescription* load) {
            load->in_link_frame = value.choice("frame", {"root", "link"}) == "link";
          })};
  return kKeys;
}

void check_wrench(const YamlValue& value) {
  const auto force = value.find("force"), point = value.find("point");
  if (!force && !value.find("torque"))
    value.fail("a load on a link needs a force or a torque", "force: [x, y, z], torque: [x, y, z]");
  if (point && !force)
    point->fail("a point without a force has no meaning: it is where the force acts",
                "force: [x, y, z]");
}

}  // namespace

std::vector<EntryForm> forms_of_loads() {
  return {{"loads[]", effort_keys()}, {"loads[]", wrench_keys()}};
}

void read_loads(const YamlValue& study_value, const RobotDescription& robot,
                const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto loads = study_value.find("loads");
  if (!loads) return;
  const EntryContext in{robot, table, loader, *study};
  for (const YamlValue& value : loads->items()) {
    LoadDescription load;
    load.where = value.where();
    if (!value.is_map())
      value.fail("a load must be a map",
                 "{joint: NAME, effort: Q} or {link: NAME, force: [x, y, z]}");
    const bool on_joint = value.find("joint").has_value(), on_link = value.find("link").has_value();
    if (on_joint == on_link)
      value.fail("a load acts on one joint or on one link",
                 "{joint: NAME, effort: Q} or {link: NAME, force: [x, y, z]}");
    read_entry(value, on_joint ? effort_keys() : wrench_keys(), in, &load);
    if (on_link) check_wrench(value);
    study->loads.push_back(std::move(load));
  }
}

}  // namespace codesign
