// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ControllerStates.h>
#include <mechanism_codesign/JointFriction.h>
#include <mechanism_codesign/LoopErrors.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/Signals.h>
#include <mechanism_codesign/Warning.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/frame.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/warning.h"

// Conversions from results of the core to ROS messages. No ROS master is needed.

namespace codesign {

/// Stamp of a message and the TF frame of the root link.
struct MessageContext {
  ros::Time stamp;
  std::string root_frame;
};

/// All one-coordinate joints of the tree. Joints of loops are left out, since they are not part of the URDF tree.
sensor_msgs::JointState joint_states(const FrameNames& names, const Frame& frame, const MessageContext& context);

mechanism_codesign::JointFriction joint_friction(const FrameNames& names, const Frame& frame, const MessageContext& context);

mechanism_codesign::ControllerStates controller_states(const FrameNames& names, const Frame& frame, const MessageContext& context);

mechanism_codesign::LoopErrors loop_errors(const FrameNames& names, const Frame& frame, const MessageContext& context);
mechanism_codesign::Signals signals(const FrameNames& names, const Frame& frame, const MessageContext& context);

/// Poses of the links that robot_state_publisher cannot place, each relative to its parent link.
tf2_msgs::TFMessage free_link_transforms(const FrameNames& names, const Frame& frame, const MessageContext& context);

/// Poses of all links but the root, each relative to its parent link, as robot_state_publisher does it, with `prefix` before each frame's
/// name. @param parents as link_parents() finds them.
tf2_msgs::TFMessage link_transforms(const FrameNames& names, const std::vector<std::size_t>& parents, const Frame& frame,
                                    const ros::Time& stamp, const std::string& prefix);

/// link_transforms(), and before them the root link at the origin of a frame with the name `prefix` without its trailing slash.
tf2_msgs::TFMessage placed_link_transforms(const FrameNames& names, const std::vector<std::size_t>& parents, const Frame& frame,
                                           const ros::Time& stamp, const std::string& prefix);

mechanism_codesign::OptimizationProgress optimization_progress(const Trial& trial, const std::vector<std::string>& parameters,
                                                               const ros::Time& stamp);

/// An Eigen vector as an array of a ROS message.
std::vector<double> to_array(const Eigen::VectorXd& values);

/// Messages for the warnings of the input files, followed by the warnings of a job.
std::vector<mechanism_codesign::Warning> warning_messages(const Warnings& of_files, const Warnings& of_job);

/// The warnings of the job alone. @param of_files the number of warnings of the input files, which come first.
Warnings warnings_of_job(const std::vector<mechanism_codesign::Warning>& messages, std::size_t of_files);

}  // namespace codesign
