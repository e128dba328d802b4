// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/commands.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "math/arrays.h"
#include "mechanism_codesign/error.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

[[noreturn]] void refuse_command(const std::string& topic, const std::string& element,
                                 const std::string& fault, const std::string& value,
                                 const std::string& allowed) {
  throw InputError({{topic, 0}, element, fault, value, allowed});
}

double finite_number(const std::string& topic, const std::string& element, double number) {
  if (!std::isfinite(number))
    refuse_command(topic, element, "not a finite number", to_decimal(number), "a finite number");
  return number;
}

void require_size(const std::string& topic, const std::string& element, std::size_t size,
                  std::size_t expected) {
  if (size != expected)
    refuse_command(topic, element, "wrong number of values", std::to_string(size),
                   std::to_string(expected) + ", one for each joint");
}

void require_once(const std::string& topic, const std::vector<std::string>& joints) {
  std::set<std::string> seen;
  for (const std::string& joint : joints)
    if (!seen.insert(joint).second)
      refuse_command(topic, joint, "the joint is named twice", joint, "each joint once");
}

std::size_t index_of_joint(const CommandInputs& inputs, const std::string& topic,
                           const std::string& joint) {
  refuse_given_motion(inputs.study, joint, topic, inputs.joints);
  const auto found = std::find(inputs.joints.begin(), inputs.joints.end(), joint);
  if (found == inputs.joints.end())
    throw unknown_name({topic, 0}, joint, "joint that takes efforts", joint, inputs.joints);
  return to_index(found - inputs.joints.begin());
}

JointCourse course_of(const CommandInputs& inputs, const std::string& topic,
                      const std::string& joint) {
  const std::optional<TrajectoryFollower> follower = follower_of(inputs, joint);
  if (!follower)
    refuse_command(
        topic, joint, "no controller of the study follows this joint", joint,
        "a joint whose position or velocity is the input of a controller that drives it");
  return {joint, *follower, {}};
}

std::optional<double> optional_number(const std::string& topic, const std::string& element,
                                      const std::vector<double>& values, std::size_t k) {
  if (values.empty()) return std::nullopt;
  return finite_number(topic, element, values[k]);
}

void add_point(const std::string& topic, std::size_t number,
               const trajectory_msgs::JointTrajectoryPoint& point, TrajectoryCommand* command) {
  const std::string place = "points[" + std::to_string(number) + "]";
  const std::size_t size = command->joints.size();
  require_size(topic, place + ".positions", point.positions.size(), size);
  if (!point.velocities.empty())
    require_size(topic, place + ".velocities", point.velocities.size(), size);
  if (!point.accelerations.empty())
    require_size(topic, place + ".accelerations", point.accelerations.size(), size);
  const double time = point.time_from_start.toSec();
  const std::vector<CoursePoint>& before = command->joints.front().points;
  if (time < 0.0 || (!before.empty() && time <= before.back().time))
    refuse_command(
        topic, place + ".time_from_start", "the times of the points must ascend from zero",
        to_decimal(time),
        before.empty() ? "at least 0 s" : "more than " + to_decimal(before.back().time) + " s");
  for (std::size_t k = 0; k < size; ++k) {
    JointCourse& course = command->joints[k];
    const std::string element = course.joint + ", " + place;
    course.points.push_back(
        {time, finite_number(topic, element + ".positions", point.positions[k]),
         optional_number(topic, element + ".velocities", point.velocities, k),
         optional_number(topic, element + ".accelerations", point.accelerations, k)});
  }
}

}  // namespace

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic,
                           const sensor_msgs::JointState& message) {
  if (message.name.empty())
    refuse_command(topic, "name", "no joint is named", "", list_names(inputs.joints));
  require_size(topic, "effort", message.effort.size(), message.name.size());
  require_once(topic, message.name);
  EffortCommand command;
  for (std::size_t k = 0; k < message.name.size(); ++k)
    command.efforts.emplace_back(index_of_joint(inputs, topic, message.name[k]),
                                 finite_number(topic, message.name[k], message.effort[k]));
  return command;
}

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic,
                           const std_msgs::Float64MultiArray& message) {
  if (message.data.size() != inputs.joints.size())
    refuse_command(
        topic, "data", "wrong number of values", std::to_string(message.data.size()),
        std::to_string(inputs.joints.size()) + ", one for each of " + list_names(inputs.joints));
  EffortCommand command;
  for (std::size_t k = 0; k < message.data.size(); ++k)
    command.efforts.emplace_back(k, finite_number(topic, inputs.joints[k], message.data[k]));
  return command;
}

SetpointCommand read_setpoint(const CommandInputs& inputs, const std::string& topic,
                              std::size_t controller, const std_msgs::Float64& message) {
  return {controller, finite_number(topic, inputs.controllers[controller], message.data)};
}

TrajectoryCommand read_trajectory(const CommandInputs& inputs, const std::string& topic,
                                  const trajectory_msgs::JointTrajectory& message) {
  TrajectoryCommand command;
  command.begin = message.header.stamp;
  require_once(topic, message.joint_names);
  if (message.joint_names.empty() && message.points.empty()) {
    for (const std::string& joint : inputs.joints)
      if (follower_of(inputs, joint)) command.joints.push_back(course_of(inputs, topic, joint));
    return command;
  }
  if (message.joint_names.empty())
    refuse_command(topic, "joint_names", "no joint is named", "", list_names(inputs.joints));
  for (const std::string& joint : message.joint_names)
    command.joints.push_back(course_of(inputs, topic, joint));
  for (std::size_t k = 0; k < message.points.size(); ++k)
    add_point(topic, k, message.points[k], &command);
  return command;
}

void CommandedRun::clear() {
  last_effort_.reset();
  timed_out_ = false;
}

void CommandedRun::take(const EffortCommand& command, const Frame& frame, const RunClock&) {
  for (const auto& [joint, effort] : command.efforts) run_->set_effort(joint, effort);
  last_effort_ = frame.time;
  timed_out_ = false;
}

void CommandedRun::take(const SetpointCommand& command, const Frame& frame, const RunClock&) {
  run_->set_course(command.controller, held(command.value, frame.time));
}

void CommandedRun::take(const TrajectoryCommand& command, const Frame& frame,
                        const RunClock& clock) {
  const double begin = command.begin.isZero() ? frame.time : clock.time_of(command.begin);
  for (const JointCourse& course : command.joints) follow(course, begin, frame);
}

// If the set-point is a velocity, the trajectory begins at the measured position.
void CommandedRun::follow(const JointCourse& course, double begin, const Frame& frame) {
  const std::vector<std::string>& joints = run_->names().joints;
  const auto found = std::find(joints.begin(), joints.end(), course.joint);
  const double position =
      found == joints.end() ? 0.0 : frame.joints[to_index(found - joints.begin())].position;
  const auto [controller, by_rate] = course.follower;
  if (course.points.empty())
    return run_->set_course(controller, held(by_rate ? 0.0 : position, frame.time));
  const double now = std::max(begin, frame.time);
  const ReferenceMotion<double> in_effect = run_->setpoint(controller, now);
  const Knot<double> from =
      by_rate ? Knot<double>{position, in_effect.value, in_effect.rate}
              : Knot<double>{in_effect.value, in_effect.rate, in_effect.acceleration};
  std::vector<CoursePoint> points = course.points;
  for (CoursePoint& point : points) point.time += begin;
  const Course pieces = trajectory_course(points, now, from);
  run_->set_course(controller, by_rate ? rate_of(pieces) : pieces);
}

bool CommandedRun::end_efforts(double time) {
  if (!(timeout_ > 0.0) || timed_out_ || !last_effort_ ||
      time - *last_effort_ < timeout_ * (1.0 - 1e-9))
    return false;
  for (std::size_t joint = 0; joint < run_->inputs().joints.size(); ++joint)
    run_->set_effort(joint, 0.0);
  timed_out_ = true;
  return true;
}

CommandedRun::Outcome CommandedRun::apply(const std::vector<Command>& commands, const Frame& frame,
                                          const RunClock& clock) {
  for (const Command& command : commands)
    std::visit([&](const auto& one) { take(one, frame, clock); }, command);
  const bool ended = end_efforts(frame.time);
  return {run_->apply(frame.time), ended || !commands.empty()};
}

mechanism_codesign::Commands CommandedRun::message(double time) const {
  mechanism_codesign::Commands message;
  const CommandInputs& inputs = run_->inputs();
  message.joints = inputs.joints;
  for (std::size_t k = 0; k < inputs.joints.size(); ++k) message.efforts.push_back(run_->effort(k));
  for (std::size_t k = 0; k < inputs.controllers.size(); ++k) {
    if (!run_->is_commanded(k)) continue;
    const ReferenceMotion<double> setpoint = run_->setpoint(k, time);
    message.controllers.push_back(inputs.controllers[k]);
    message.setpoints.push_back(setpoint.value);
    message.setpoint_rates.push_back(setpoint.rate);
  }
  return message;
}

}  // namespace codesign
