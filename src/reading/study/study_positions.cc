// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr double kMostPostures = 10000;

/// The number of values of one joint.
int count_values(const YamlValue& value) {
  const YamlValue at = value.is_map() ? value.at("count") : value;
  const double count = value.is_map() ? at.number() : static_cast<double>(value.items().size());
  const double least = value.is_map() ? 2.0 : 1.0;
  if (!(count >= least && count <= kMostPostures) || count != std::floor(count))
    at.fail("found " + to_decimal(count) + " postures",
            "a whole number from " + to_decimal(least) + " to " + to_decimal(kMostPostures));
  return static_cast<int>(count);
}

std::string in_parentheses(const Quantity& quantity) {
  return "(" +
         (quantity.is_constant() ? to_decimal(quantity.nominal()) : quantity.expression()->text()) +
         ")";
}

/// The value at the part `k / last` of the way.
Quantity between(const Quantity& from, const Quantity& to, int k, int last,
                 const ParameterTable& table) {
  if (k == 0) return from;
  if (k == last) return to;
  const double part = static_cast<double>(k) / last;
  const double value = from.nominal() + part * (to.nominal() - from.nominal());
  if (from.is_constant() && to.is_constant()) return Quantity(value);
  return Quantity(value, table.parse(in_parentheses(from) + " + " + to_decimal(part) + "*(" +
                                     in_parentheses(to) + " - " + in_parentheses(from) + ")"));
}

std::vector<Quantity> read_values(const YamlValue& value, const ParameterTable& table) {
  std::vector<Quantity> values;
  if (!value.is_map()) {
    for (const YamlValue& item : value.items()) values.push_back(read_quantity(item, table));
    return values;
  }
  value.require_keys({"from", "to", "count"}, {});
  const Quantity from = read_quantity(value.at("from"), table),
                 to = read_quantity(value.at("to"), table);
  const int count = count_values(value);
  for (int k = 0; k < count; ++k) values.push_back(between(from, to, k, count - 1, table));
  return values;
}

/// Whether a drive holds this joint: `hold` is true or a list of joints with positions.
bool is_held(const std::string& joint, const YamlValue& hold) {
  if (!hold.is_list()) return hold.boolean();
  const std::vector<YamlValue> items = hold.items();
  return std::any_of(items.begin(), items.end(),
                     [&](const YamlValue& item) { return item.text() == joint; });
}

/// A function with these values in the postures 0, 1, ...
ReferenceDescription by_posture(std::vector<Quantity> values) {
  ReferenceDescription reference;
  reference.kind = ReferenceDescription::Kind::kWaypoints;
  for (std::size_t k = 0; k < values.size(); ++k)
    reference.waypoints.times.push_back(static_cast<double>(k));
  reference.waypoints.positions = std::move(values);
  return reference;
}

/// The motion that holds a joint in posture k at the time k, with the velocity that the start
/// gives.
GivenMotion holding_motion(const InitialJointState& state) {
  GivenMotion motion;
  motion.joint = state.joint;
  motion.where = state.where;
  motion.position = by_posture(state.positions);
  WaypointsDescription& points = motion.position.waypoints;
  points.velocities.assign(points.times.size(), state.velocity.value_or(Quantity(0.0)));
  points.accelerations.assign(points.times.size(), Quantity(0.0));
  return motion;
}

/// Makes the positions of joints that are held motions that are given.
void hold_joints(const YamlValue& hold, const YamlValue& positions, Study* study) {
  if (hold.is_list())
    for (const YamlValue& item : hold.items())
      if (!positions.find(item.text()))
        item.fail("no positions of this joint", "true, or a list of joints of `positions`");
  std::vector<InitialJointState> free;
  for (InitialJointState& state : study->initial_state)
    if (state.positions.empty() || !is_held(state.joint, hold))
      free.push_back(std::move(state));
    else
      study->motion.push_back(holding_motion(state));
  study->initial_state = std::move(free);
}

}  // namespace

int count_postures(const YamlValue& study_value) {
  const auto positions = study_value.find("positions");
  if (!positions) return 0;
  for (const char* key :
       {"duration", "until", "controllers", "motion", "identify", "excite", "hardware"})
    if (const auto other = study_value.find(key))
      other->fail("a study with positions has postures in place of a motion",
                  "either positions or " + std::string(key));
  const auto joints = positions->entries();
  if (joints.empty()) positions->fail("no joint has positions", "JOINT: [position, ...]");
  const int count = count_values(joints.front().second);
  for (const auto& [name, value] : joints)
    if (const int own = count_values(value); own != count)
      value.fail("found " + std::to_string(own) + " positions, and of joint '" +
                     joints.front().first + "' " + std::to_string(count),
                 "one per posture");
  return count;
}

void read_positions(const YamlValue& study_value, const RobotDescription& robot,
                    const ParameterTable& table, Study* study) {
  const auto positions = study_value.find("positions");
  const auto hold = study_value.find("hold");
  if (hold && !positions)
    hold->fail("a drive holds joints in postures, and the study has none", "positions");
  if (!positions) return;
  for (const auto& [name, value] : positions->entries()) {
    const JointDescription& joint = scalar_joint(name, robot, value);
    if (joint.is_loop)
      value.fail("a loop follows from the joints of the tree", "a joint of the tree");
    auto state =
        std::find_if(study->initial_state.begin(), study->initial_state.end(),
                     [&](const InitialJointState& one) { return one.joint == joint.name; });
    if (state == study->initial_state.end()) {
      state = study->initial_state.emplace(state);
      state->joint = joint.name;
      state->where = value.where();
    } else if (state->position || state->guess) {
      value.fail("initial_state gives a position or a guess of this joint, too",
                 "positions of a joint in one place");
    }
    state->positions = read_values(value, table);
    state->position = state->positions.front();
  }
  if (hold) hold_joints(*hold, *positions, study);
}

ReferenceDescription read_target(const YamlValue& value, const ParameterTable& table,
                                 const TrajectoryLoader& loader, const Study& study) {
  if (study.postures == 0 || !value.is_list()) return read_reference(value, table, loader);
  const std::vector<YamlValue> items = value.items();
  if (static_cast<int>(items.size()) != study.postures)
    value.fail("found " + std::to_string(items.size()) + " values for " +
                   std::to_string(study.postures) + " postures",
               "one per posture");
  if (items.size() == 1) return read_quantity(items.front(), table);
  ReferenceDescription reference = by_posture(read_values(value, table));
  reference.waypoints.interpolation = Interpolation::kLinear;
  return reference;
}

}  // namespace codesign
