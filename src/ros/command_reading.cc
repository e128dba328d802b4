// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/command_reading.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "mechanism_codesign/error.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

[[noreturn]] void refuse_command(const std::string& topic, const std::string& element, const std::string& fault, const std::string& value,
                                 const std::string& allowed) {
  throw InputError({{topic, 0}, element, fault, value, allowed});
}

double finite_number(const std::string& topic, const std::string& element, double number) {
  if (!std::isfinite(number)) refuse_command(topic, element, "not a finite number", to_decimal(number), "a finite number");
  return number;
}

void require_size(const std::string& topic, const std::string& element, std::size_t size, std::size_t expected) {
  if (size != expected)
    refuse_command(topic, element, "wrong number of values", std::to_string(size), std::to_string(expected) + ", one for each joint");
}

void require_once(const std::string& topic, const std::vector<std::string>& joints) {
  std::set<std::string> seen;
  for (const std::string& joint : joints)
    if (!seen.insert(joint).second) refuse_command(topic, joint, "the joint is named twice", joint, "each joint once");
}

std::size_t index_of_joint(const CommandInputs& inputs, const std::string& topic, const std::string& joint) {
  const auto found = std::find(inputs.joints.begin(), inputs.joints.end(), joint);
  if (found == inputs.joints.end()) throw unknown_name({topic, 0}, joint, "joint that takes efforts", joint, inputs.joints);
  return static_cast<std::size_t>(found - inputs.joints.begin());
}

JointCourse course_of(const CommandInputs& inputs, const std::string& topic, const std::string& joint) {
  const std::optional<TrajectoryFollower> follower = follower_of(inputs, joint);
  if (!follower)
    refuse_command(topic, joint, "no controller of the study follows this joint", joint,
                   "a joint whose position or velocity is the input of a controller that drives it");
  return {joint, *follower, {}};
}

std::optional<double> optional_number(const std::string& topic, const std::string& element, const std::vector<double>& values,
                                      std::size_t k) {
  if (values.empty()) return std::nullopt;
  return finite_number(topic, element, values[k]);
}

void add_point(const std::string& topic, std::size_t number, const trajectory_msgs::JointTrajectoryPoint& point,
               TrajectoryCommand* command) {
  const std::string place = "points[" + std::to_string(number) + "]";
  const std::size_t size = command->joints.size();
  require_size(topic, place + ".positions", point.positions.size(), size);
  if (!point.velocities.empty()) require_size(topic, place + ".velocities", point.velocities.size(), size);
  if (!point.accelerations.empty()) require_size(topic, place + ".accelerations", point.accelerations.size(), size);
  const double time = point.time_from_start.toSec();
  const std::vector<CoursePoint>& before = command->joints.front().points;
  if (time < 0.0 || (!before.empty() && time <= before.back().time))
    refuse_command(topic, place + ".time_from_start", "the times of the points must ascend from zero", to_decimal(time),
                   before.empty() ? "at least 0 s" : "more than " + to_decimal(before.back().time) + " s");
  for (std::size_t k = 0; k < size; ++k) {
    JointCourse& course = command->joints[k];
    const std::string element = course.joint + ", " + place;
    course.points.push_back({time, finite_number(topic, element + ".positions", point.positions[k]),
                             optional_number(topic, element + ".velocities", point.velocities, k),
                             optional_number(topic, element + ".accelerations", point.accelerations, k)});
  }
}

}  // namespace

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic, const sensor_msgs::JointState& message) {
  if (message.name.empty()) refuse_command(topic, "name", "no joint is named", "", list_names(inputs.joints));
  require_size(topic, "effort", message.effort.size(), message.name.size());
  require_once(topic, message.name);
  EffortCommand command;
  for (std::size_t k = 0; k < message.name.size(); ++k)
    command.efforts.emplace_back(index_of_joint(inputs, topic, message.name[k]), finite_number(topic, message.name[k], message.effort[k]));
  return command;
}

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic, const std_msgs::Float64MultiArray& message) {
  if (message.data.size() != inputs.joints.size())
    refuse_command(topic, "data", "wrong number of values", std::to_string(message.data.size()),
                   std::to_string(inputs.joints.size()) + ", one for each of " + list_names(inputs.joints));
  EffortCommand command;
  for (std::size_t k = 0; k < message.data.size(); ++k)
    command.efforts.emplace_back(k, finite_number(topic, inputs.joints[k], message.data[k]));
  return command;
}

SetpointCommand read_setpoint(const CommandInputs& inputs, const std::string& topic, std::size_t controller,
                              const std_msgs::Float64& message) {
  return {controller, finite_number(topic, inputs.controllers[controller], message.data)};
}

TrajectoryCommand read_trajectory(const CommandInputs& inputs, const std::string& topic, const trajectory_msgs::JointTrajectory& message) {
  TrajectoryCommand command;
  command.begin = message.header.stamp;
  require_once(topic, message.joint_names);
  if (message.joint_names.empty() && message.points.empty()) {
    for (const std::string& joint : inputs.joints)
      if (follower_of(inputs, joint)) command.joints.push_back(course_of(inputs, topic, joint));
    return command;
  }
  if (message.joint_names.empty()) refuse_command(topic, "joint_names", "no joint is named", "", list_names(inputs.joints));
  for (const std::string& joint : message.joint_names) command.joints.push_back(course_of(inputs, topic, joint));
  for (std::size_t k = 0; k < message.points.size(); ++k) add_point(topic, k, message.points[k], &command);
  return command;
}

}  // namespace codesign
