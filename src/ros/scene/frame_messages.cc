// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/frame_messages.h"

#include <cstdint>

#include "math/scalar.h"

namespace codesign {
namespace {

/// The pose of a link relative to another one, without the names of the frames.
geometry_msgs::TransformStamped transform_of(const LinkSample& parent, const LinkSample& child) {
  const Eigen::Quaterniond to_parent = parent.orientation.conjugate();
  const Eigen::Vector3d position = to_parent * (child.position - parent.position);
  const Eigen::Quaterniond orientation = (to_parent * child.orientation).normalized();
  geometry_msgs::TransformStamped message;
  message.transform.translation = xyz<geometry_msgs::Vector3>(position);
  message.transform.rotation.w = orientation.w();
  message.transform.rotation.x = orientation.x();
  message.transform.rotation.y = orientation.y();
  message.transform.rotation.z = orientation.z();
  return message;
}

}  // namespace

sensor_msgs::JointState joint_states(const FrameNames& names, const Frame& frame,
                                     const MessageContext& context) {
  sensor_msgs::JointState message;
  message.header = header_of(context);
  for (std::size_t i = 0; i < names.tree_joints; ++i) {
    message.name.push_back(names.joints[i]);
    message.position.push_back(frame.joints[i].position);
    message.velocity.push_back(frame.joints[i].velocity);
    message.effort.push_back(frame.joints[i].effort);
  }
  return message;
}

mechanism_codesign::JointFriction joint_friction(const FrameNames& names, const Frame& frame,
                                                 const MessageContext& context) {
  mechanism_codesign::JointFriction message;
  message.header = header_of(context);
  message.name = names.frictions;
  message.is_torque.assign(names.friction_is_torque.begin(), names.friction_is_torque.end());
  for (const FrictionSample& sample : frame.frictions) {
    message.friction.push_back(sample.friction);
    message.normal_force.push_back(sample.normal_force);
    message.sliding_velocity.push_back(sample.sliding_velocity);
  }
  return message;
}

mechanism_codesign::ControllerStates controller_states(const FrameNames& names, const Frame& frame,
                                                       const MessageContext& context) {
  mechanism_codesign::ControllerStates message;
  message.header = header_of(context);
  message.name = names.controllers;
  for (const ControllerSample& sample : frame.controllers) {
    message.setpoint.push_back(sample.setpoint);
    message.input.push_back(sample.input);
    message.error.push_back(sample.error);
    message.integral.push_back(sample.integral);
    message.output.push_back(sample.output);
  }
  return message;
}

mechanism_codesign::LoopErrors loop_errors(const FrameNames& names, const Frame& frame,
                                           const MessageContext& context) {
  mechanism_codesign::LoopErrors message;
  message.header = header_of(context);
  message.name = names.loops;
  message.error = frame.loop_errors;
  return message;
}

mechanism_codesign::Signals signals(const FrameNames& names, const Frame& frame,
                                    const MessageContext& context) {
  mechanism_codesign::Signals message;
  message.header = header_of(context);
  message.name = names.signals;
  message.value = frame.signals;
  return message;
}

tf2_msgs::TFMessage free_link_transforms(const FrameNames& names, const Frame& frame,
                                         const MessageContext& context) {
  tf2_msgs::TFMessage message;
  for (const auto& [link, parent] : names.free_links) {
    geometry_msgs::TransformStamped transform =
        transform_of(frame.links[parent], frame.links[link]);
    transform.header = header_of({context.stamp, names.links[parent]});
    transform.child_frame_id = names.links[link];
    message.transforms.push_back(transform);
  }
  return message;
}

tf2_msgs::TFMessage link_transforms(const FrameNames& names,
                                    const std::vector<std::size_t>& parents, const Frame& frame,
                                    const ros::Time& stamp, const std::string& prefix) {
  tf2_msgs::TFMessage message;
  for (std::size_t i = 0; i < names.links.size(); ++i) {
    if (parents[i] == i) continue;
    geometry_msgs::TransformStamped transform =
        transform_of(frame.links[parents[i]], frame.links[i]);
    transform.header = header_of({stamp, prefix + names.links[parents[i]]});
    transform.child_frame_id = prefix + names.links[i];
    message.transforms.push_back(transform);
  }
  return message;
}

tf2_msgs::TFMessage placed_link_transforms(const FrameNames& names,
                                           const std::vector<std::size_t>& parents,
                                           const Frame& frame, const ros::Time& stamp,
                                           const std::string& prefix) {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped root = transform_of(frame.links[0], frame.links[0]);
  root.header = header_of({stamp, prefix.substr(0, prefix.size() - 1)});
  root.child_frame_id = prefix + names.links[0];
  message.transforms.push_back(root);
  const tf2_msgs::TFMessage links = link_transforms(names, parents, frame, stamp, prefix);
  message.transforms.insert(message.transforms.end(), links.transforms.begin(),
                            links.transforms.end());
  return message;
}

FrameMessages::FrameMessages(const FrameNames& names, const Frame& frame,
                             const MessageContext& context, const MarkerStyle& style)
    : joint_states(codesign::joint_states(names, frame, context)),
      joint_friction(codesign::joint_friction(names, frame, context)),
      controller_states(codesign::controller_states(names, frame, context)),
      loop_errors(codesign::loop_errors(names, frame, context)),
      signals(codesign::signals(names, frame, context)),
      friction_markers(codesign::friction_markers(names, frame, context, style)) {}

}  // namespace codesign
