// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_FRICTION_MARKERS_H_
#define MECHANISM_CODESIGN_ROS_FRICTION_MARKERS_H_

#include <visualization_msgs/MarkerArray.h>

#include "mechanism_codesign/frame.h"
#include "ros/conversions.h"

namespace codesign {

/// Scales of the arrows that show friction.
struct MarkerStyle {
  double metres_per_newton = 0.01;       ///< length of a force arrow per newton [m/N]
  double metres_per_newton_metre = 0.1;  ///< length of a torque arrow per newton metre [m/(N m)]
  double shaft_diameter = 0.006;         ///< [m]
};

/// An arrow without frame, name and color. One shorter than its shaft diameter, or not finite, is removed instead of drawn.
visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double shaft_diameter);

/// One arrow for each joint and loop with friction, from the joint along the friction force (red) or torque (cyan) on the child link.
visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame, const MessageContext& context,
                                                 const MarkerStyle& style);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_FRICTION_MARKERS_H_
