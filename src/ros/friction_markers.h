// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <memory>

#include "mechanism_codesign/frame.h"
#include "reading/urdf/pictures.h"
#include "ros/conversions.h"

namespace codesign {

/// Scales of the arrows that show friction, and the solids that must not hide them.
struct MarkerStyle {
  double metres_per_newton = 0.01;       ///< length of a force arrow per newton [m/N]
  double metres_per_newton_metre = 0.1;  ///< length of a torque arrow per newton metre [m/(N m)]
  double shaft_diameter = 0.006;         ///< [m]
  Eigen::Vector3d towards_viewer =
      Eigen::Vector3d::Zero();                        ///< unit vector in the root's axes from the mechanism to the viewer; zero: none
  std::shared_ptr<const LinkBoxes> solids = nullptr;  ///< in the order of the frame's links; null: arrows begin at their joints
  double longest = std::numeric_limits<double>::infinity();  ///< longer arrows are cut [m]
};

/// Where an arrow begins and ends, in world axes [m].
struct ArrowEnds {
  Eigen::Vector3d from, to;
};

/// The arrow of one friction, as long as the style says and not hidden in the solids of the style.
///
/// A force moves sideways, at a right angle to itself towards the viewer, until it is outside. A torque moves along its axis towards the
/// viewer until all of it is outside; it begins at the solid if it points to the viewer, else it ends there, with its head in sight.
ArrowEnds friction_arrow(const FrictionSample& sample, bool is_torque, const Frame& frame, const MarkerStyle& style);

/// An arrow without frame, name and color. An arrow that is shorter than its shaft diameter, or not finite, is removed instead of drawn.
visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double shaft_diameter);

/// The color of arrows that show friction: red for a force, cyan for a torque.
std_msgs::ColorRGBA friction_color(bool is_torque);

/// One arrow for each joint and loop with friction, along the friction force (red) or torque (cyan) on the child link.
visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame, const MessageContext& context,
                                                 const MarkerStyle& style);

}  // namespace codesign
