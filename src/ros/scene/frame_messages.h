// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/ControllerStates.h>
#include <mechanism_codesign/JointFriction.h>
#include <mechanism_codesign/LoopErrors.h>
#include <mechanism_codesign/Signals.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "ros/scene/markers.h"

namespace codesign {

/// All one-coordinate joints of the tree. Joints of loops are left out, since they are not part of
/// the URDF tree.
sensor_msgs::JointState joint_states(const FrameNames& names, const Frame& frame,
                                     const MessageContext& context);

mechanism_codesign::JointFriction joint_friction(const FrameNames& names, const Frame& frame,
                                                 const MessageContext& context);

mechanism_codesign::ControllerStates controller_states(const FrameNames& names, const Frame& frame,
                                                       const MessageContext& context);

mechanism_codesign::LoopErrors loop_errors(const FrameNames& names, const Frame& frame,
                                           const MessageContext& context);
mechanism_codesign::Signals signals(const FrameNames& names, const Frame& frame,
                                    const MessageContext& context);

/// Poses of the links that robot_state_publisher cannot place, each relative to its parent link.
tf2_msgs::TFMessage free_link_transforms(const FrameNames& names, const Frame& frame,
                                         const MessageContext& context);

/// Poses of all links but the root, each relative to its parent link, as robot_state_publisher does
/// it, with `prefix` before each frame's name. @param parents as link_parents() finds them.
tf2_msgs::TFMessage link_transforms(const FrameNames& names,
                                    const std::vector<std::size_t>& parents, const Frame& frame,
                                    const ros::Time& stamp, const std::string& prefix);

/// link_transforms(), and before them the root link at the origin of a frame with the name `prefix`
/// without its trailing slash.
tf2_msgs::TFMessage placed_link_transforms(const FrameNames& names,
                                           const std::vector<std::size_t>& parents,
                                           const Frame& frame, const ros::Time& stamp,
                                           const std::string& prefix);

/// The messages of one instant that the simulation node publishes and a bag records. The members'
/// names are the topics.
struct FrameMessages {
  sensor_msgs::JointState joint_states;
  mechanism_codesign::JointFriction joint_friction;
  mechanism_codesign::ControllerStates controller_states;
  mechanism_codesign::LoopErrors loop_errors;
  mechanism_codesign::Signals signals;
  visualization_msgs::MarkerArray friction_markers;

  FrameMessages(const FrameNames& names, const Frame& frame, const MessageContext& context,
                const MarkerStyle& style);

  /// Calls `visitor(topic, message)` for each message.
  template <class Visitor>
  void visit(Visitor&& visitor) const {
    visitor("joint_states", joint_states);
    visitor("joint_friction", joint_friction);
    visitor("controller_states", controller_states);
    visitor("loop_errors", loop_errors);
    visitor("signals", signals);
    visitor("friction_markers", friction_markers);
  }
};

}  // namespace codesign
