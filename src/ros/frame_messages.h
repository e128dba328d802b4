// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ros/conversions.h"
#include "ros/friction_markers.h"

namespace codesign {

/// The messages of one instant that the simulation node publishes and a bag records. The members' names are the topics.
struct FrameMessages {
  sensor_msgs::JointState joint_states;
  mechanism_codesign::JointFriction joint_friction;
  mechanism_codesign::ControllerStates controller_states;
  mechanism_codesign::LoopErrors loop_errors;
  mechanism_codesign::Signals signals;
  visualization_msgs::MarkerArray friction_markers;

  FrameMessages(const FrameNames& names, const Frame& frame, const MessageContext& context, const MarkerStyle& style);

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
