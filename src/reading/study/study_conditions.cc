// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "description/expression_syntax.h"
#include "math/scalar.h"
#include "mechanism/signal_catalog.h"
#include "reading/study/signal_table.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Names = std::vector<std::string>;

const Names& scalar_keys() {
  static const Names kKeys{"position", "velocity", "guess"};
  return kKeys;
}
const Names& pose_keys() {
  static const Names kKeys{"translation", "rotation", "linear_velocity", "angular_velocity"};
  return kKeys;
}

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
  Names known;
  for (const JointDescription& joint : robot.joints) {
    const bool free = joint.has_pose();
    if (joint.name == name && (free || joint.has_one_coordinate() || can_stick(joint)))
      return joint;
    if (joint.name == name)
      value.fail("this joint has neither a single coordinate nor a pose",
                 "a revolute, continuous, prismatic, planar or floating joint");
    if (free || joint.has_one_coordinate()) known.push_back(joint.name);
  }
  throw unknown_name(value.where(), value.path(), "joint", name, known);
}

void read_scalar_start(const YamlValue& value, const ParameterTable& table,
                       InitialJointState* state) {
  if (const auto position = value.find("position"))
    state->position = read_quantity(*position, table);
  if (const auto velocity = value.find("velocity"))
    state->velocity = read_quantity(*velocity, table);
  const auto guess = value.find("guess");
  if (guess && state->position)
    guess->fail("a joint has either a position or a guess of it",
                "position, which is kept, or guess, where the search for a closed loop begins");
  if (guess) state->guess = guess->number();
}

/// Checks that a joint can slide along a vector, at the parameters' start values: in the plane
/// normal to its axis, or along the axis.
void check_slide(const YamlValue& value, const QuantityVector& vector,
                 const JointDescription& joint) {
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

void read_pose_start(const YamlValue& value, const JointDescription& joint,
                     const ParameterTable& table, InitialJointState* state) {
  const bool turns_once = joint.freedoms().turns == 1;
  const auto slide = [&](const char* key, std::optional<QuantityVector>* result) {
    const auto found = value.find(key);
    if (!found) return;
    *result = read_vector(*found, table);
    check_slide(*found, **result, joint);
  };
  const auto turn = [&](const char* key, std::optional<QuantityVector>* result) {
    const auto found = value.find(key);
    if (!found) return;
    if (turns_once && found->is_list())
      found->fail(joint.freedoms().slides == 2 ? "a planar joint turns only about its normal"
                                               : "this joint turns only about its axis",
                  "one number");
    *result = turns_once ? QuantityVector{0.0, 0.0, read_quantity(*found, table)}
                         : read_vector(*found, table);
  };
  slide("translation", &state->translation);
  slide("linear_velocity", &state->linear_velocity);
  turn("rotation", &state->rotation);
  turn("angular_velocity", &state->angular_velocity);
  // An angular velocity needs a known rotation: zero if it is not given.
  if (state->angular_velocity && !state->rotation) state->rotation.emplace();
}

/// Reads `stuck`: the joint is at rest, held by its bristles.
void read_stuck(const YamlValue& value, const JointDescription& joint, InitialJointState* state) {
  const auto stuck = value.find("stuck");
  if (!stuck || !stuck->boolean()) return;
  if (!can_stick(joint)) {
    if (joint.actuator && joint.actuator->elastic && joint.actuator->gear &&
        joint.actuator->gear->slip.model->bristle)
      stuck->fail(
          "the gear of the joint is elastic and starts undeflected, so that friction of its flanks "
          "does not hold the joint",
          "friction with states at the joint itself, or a gear without stiffness");
    stuck->fail("the joint has no friction with states, which alone can hold it at rest",
                "model=\"lugre\" or \"gonthier\" in its <codesign:friction>, or model=\"lugre\" "
                "in its <codesign:actuator>");
  }
  if (state->velocity || state->linear_velocity || state->angular_velocity)
    stuck->fail("a joint that starts stuck is at rest, and its velocity is given, too",
                "either stuck or a velocity");
  state->stuck = true;
  if (joint.is_loop) return;
  if (joint.has_pose())
    state->linear_velocity.emplace(), state->angular_velocity.emplace();
  else
    state->velocity = Quantity(0.0);
}

/// Reads `current`, of the winding of the joint's motor.
void read_current(const YamlValue& value, const JointDescription& joint,
                  const ParameterTable& table, InitialJointState* state) {
  const auto current = value.find("current");
  if (!current) return;
  if (!joint.has_winding() || !joint.actuator->winding->has_state())
    current->fail(
        "the motor of the joint has no inductance, so that its current does not start: "
        "it follows from the voltage",
        "an inductance in its <codesign:actuator>");
  state->current = read_quantity(*current, table);
}

InitialJointState read_joint_start(const std::string& name, const YamlValue& value,
                                   const RobotDescription& robot, const ParameterTable& table) {
  const JointDescription& joint = starting_joint(name, robot, value);
  const bool pose = joint.has_pose(), scalar = joint.has_one_coordinate();
  Names keys = pose ? pose_keys() : scalar ? scalar_keys() : Names();
  const Names& others = pose ? scalar_keys() : pose_keys();
  keys.emplace_back("stuck");
  if (joint.has_winding()) keys.emplace_back("current");
  if (value.is_map())
    for (const auto& [key, at] : value.entries())
      if (std::find(others.begin(), others.end(), key) != others.end())
        at.fail("this joint's start has no " + key, list_names(keys));
  value.require_keys({}, keys);
  if (value.entries().empty())
    value.fail("no initial state is given for this joint", list_names(keys));
  InitialJointState state;
  state.joint = joint.name;
  state.where = value.where();
  if (pose) read_pose_start(value, joint, table, &state);
  if (scalar) read_scalar_start(value, table, &state);
  read_stuck(value, joint, &state);
  read_current(value, joint, table, &state);
  return state;
}

}  // namespace

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

/// What the loads of a study are read with.
struct LoadReader {
  const RobotDescription& robot;
  const ParameterTable& table;
  const TrajectoryLoader& loader;
  const Study& study;

  LoadFunction read(const YamlValue& value) const {
    LoadFunction function;
    SignalDescription signal;
    if (is_table(value))
      signal = read_signal_table(value, table);
    else if (!value.is_map() && is_expression(value.text()))
      signal = parse_signal(value.text(), value.where(), value.path());
    if (signal.terms.empty()) {
      function.of_time = read_of_time(value);
      return function;
    }
    check_signal(signal, robot, study.controllers, value.path());
    use_parameters(signal, table);
    function.of_signals = std::make_shared<const SignalDescription>(std::move(signal));
    return function;
  }

  /// A function of time. In `${2*elbow/positon}` the word after the joint is no quantity, so that
  /// there is no signal: the error shall tell that, not that `elbow` is no parameter.
  ReferenceDescription read_of_time(const YamlValue& value) const {
    try {
      return read_reference(value, table, loader);
    } catch (const InputError&) {
      if (!value.is_map() && is_expression(value.text())) refuse_unknown_quantity(value);
      throw;
    }
  }

  /// Refuses the first word that follows the name of a joint, link or controller and a slash.
  void refuse_unknown_quantity(const YamlValue& value) const {
    const std::string text = value.text();
    const auto check = [&](const std::string& name) {
      const std::size_t at = text.find(name + "/"), word = at + name.size() + 1;
      if (at == std::string::npos || table.index.count(name) > 0) return;
      if (continues_identifier(text[at - 1])) return;
      std::size_t end = word;
      while (end < text.size() && continues_identifier(text[end])) ++end;
      if (end == word) return;
      const std::string quantity = text.substr(word, end - word);
      check_signal({name + "/" + quantity, {{1.0, name, quantity, ""}}, value.where(), nullptr},
                   robot, study.controllers, value.path());
    };
    for (const JointDescription& joint : robot.joints) check(joint.name);
    for (const LinkDescription& link : robot.links) check(link.name);
    for (const ControllerDescription& controller : study.controllers) check(controller.name);
  }

  std::array<LoadFunction, 3> read_components(const YamlValue& value) const {
    if (!value.is_list()) value.fail("three components are needed", "[x, y, z]");
    const std::vector<YamlValue> items = value.items();
    if (items.size() != 3)
      value.fail("three components are needed, found " + std::to_string(items.size()), "[x, y, z]");
    return {read(items[0]), read(items[1]), read(items[2])};
  }

  void read_effort(const YamlValue& value, LoadDescription* load) const {
    value.require_keys({"joint", "effort"}, {});
    const YamlValue joint = value.at("joint");
    load->joint = scalar_joint(joint.text(), robot, joint).name;
    load->effort = read(value.at("effort"));
  }

  void read_wrench(const YamlValue& value, LoadDescription* load) const {
    value.require_keys({"link"}, {"force", "torque", "point", "frame"});
    const YamlValue link = value.at("link");
    std::vector<std::string> known;
    for (const LinkDescription& description : robot.links) known.push_back(description.name);
    load->link = link.choice("link", known);
    const auto force = value.find("force"), torque = value.find("torque"),
               point = value.find("point"), frame = value.find("frame");
    if (!force && !torque)
      value.fail("a load on a link needs a force or a torque",
                 "force: [x, y, z], torque: [x, y, z]");
    if (point && !force)
      point->fail("a point without a force has no meaning: it is where the force acts",
                  "force: [x, y, z]");
    if (force) load->force = read_components(*force);
    if (torque) load->torque = read_components(*torque);
    if (point) load->point = read_vector(*point, table);
    if (frame) load->in_link_frame = frame->choice("frame", {"root", "link"}) == "link";
  }
};

}  // namespace

void read_loads(const YamlValue& study_value, const RobotDescription& robot,
                const ParameterTable& table, const TrajectoryLoader& loader, Study* study) {
  const auto loads = study_value.find("loads");
  if (!loads) return;
  const LoadReader reader{robot, table, loader, *study};
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
    on_joint ? reader.read_effort(value, &load) : reader.read_wrench(value, &load);
    study->loads.push_back(load);
  }
}

}  // namespace codesign
