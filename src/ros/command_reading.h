// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "integration/command_inputs.h"

// Commands from messages. Each function throws InputError, whose text names topic, joint and value, for a message that cannot be used.

namespace codesign {

/// Efforts [N m or N] by the index of their joint in CommandInputs::joints.
struct EffortCommand {
  std::vector<std::pair<std::size_t, double>> efforts;
};

/// A set-point in the unit of the controller's input. @param controller index in CommandInputs::controllers
struct SetpointCommand {
  std::size_t controller = 0;
  double value = 0.0;
};

/// A trajectory of one joint; times count from the begin of the trajectory. Without points the joint holds its position.
struct JointCourse {
  std::string joint;
  TrajectoryFollower follower;
  std::vector<CoursePoint> points;
};

struct TrajectoryCommand {
  ros::Time begin;  ///< zero: it begins when it takes effect
  std::vector<JointCourse> joints;
};

using Command = std::variant<EffortCommand, SetpointCommand, TrajectoryCommand>;

EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic, const sensor_msgs::JointState& message);
EffortCommand read_efforts(const CommandInputs& inputs, const std::string& topic, const std_msgs::Float64MultiArray& message);
SetpointCommand read_setpoint(const CommandInputs& inputs, const std::string& topic, std::size_t controller,
                              const std_msgs::Float64& message);
/// Without joints and points: every joint whose controller can follow trajectories holds its position.
TrajectoryCommand read_trajectory(const CommandInputs& inputs, const std::string& topic, const trajectory_msgs::JointTrajectory& message);

}  // namespace codesign
