// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <memory>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "reading/urdf/pictures.h"

namespace codesign {

struct ComparedMotion;

/// Stamp of a message and the TF frame of the root link.
struct MessageContext {
  ros::Time stamp;
  std::string root_frame;
};

std_msgs::Header header_of(const MessageContext& context);

/// A place or a displacement as a message with x, y and z.
template <class Message>
Message xyz(const Eigen::Vector3d& vector) {
  Message message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

/// The distance from a point to the outside of all solids along a ray [m]: the smallest s >= 0 such
/// that the next `clearance` metres beyond `from` + s * `along` lie in no box. Boxes that touch, or
/// are nearer to each other than `clearance`, are left together.
/// @param along a unit vector, in world axes like `from`. @param boxes in the order of the frame's
/// links.
double way_out(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const Frame& frame,
               const LinkBoxes& boxes, double clearance);

/// Scales of the arrows that show friction, and the solids that must not hide them.
struct MarkerStyle {
  double metres_per_newton = 0.01;       ///< length of a force arrow per newton [m/N]
  double metres_per_newton_metre = 0.1;  ///< length of a torque arrow per newton metre [m/(N m)]
  double shaft_diameter = 0.006;         ///< [m]
  /// unit vector in the root's axes from the mechanism to the viewer; zero: none
  Eigen::Vector3d towards_viewer = Eigen::Vector3d::Zero();
  /// in the order of the frame's links; null: arrows begin at their joints
  std::shared_ptr<const LinkBoxes> solids = nullptr;
  double longest = std::numeric_limits<double>::infinity();  ///< longer arrows are cut [m]
};

/// Where an arrow begins and ends, in world axes [m].
struct ArrowEnds {
  Eigen::Vector3d from, to;
};

/// The arrow of one friction, as long as the style says and not hidden in the solids of the style.
///
/// A force moves sideways, at a right angle to itself towards the viewer, until it is outside. A
/// torque moves along its axis towards the viewer until all of it is outside; it begins at the
/// solid if it points to the viewer, else it ends there, with its head in sight.
ArrowEnds friction_arrow(const FrictionSample& sample, bool is_torque, const Frame& frame,
                         const MarkerStyle& style);

/// An arrow without frame, name and color. An arrow that is shorter than its shaft diameter, or not
/// finite, is removed instead of drawn.
visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                                        double shaft_diameter);

/// The color of arrows that show friction: red for a force, cyan for a torque.
std_msgs::ColorRGBA friction_color(bool is_torque);

/// One arrow for each joint and loop with friction, along the friction force (red) or torque (cyan)
/// on the child link.
visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame,
                                                 const MessageContext& context,
                                                 const MarkerStyle& style);

/// A line of a text, with its color.
struct CaptionLine {
  std::string text;
  std_msgs::ColorRGBA color;
};

/// Scales of the arrows that show efforts: the largest one of each unit is as long as half the
/// mechanism.
/// @param size of the mechanism [m].
MarkerStyle effort_style(const ComparedMotion& motion, double size);

/// The legend of these arrows, in their colors; empty if no effort is compared.
std::vector<CaptionLine> effort_legend(const MarkerStyle& style, const ComparedMotion& motion);

/// Two arrows for each compared joint, beside its child's origin, along its axis: the effort that
/// the model needs (green), and around it the recorded effort (grey, thick and transparent). If the
/// model explains the recording, both arrows end at the same point.
/// @param context.root_frame the frame of the root link of the identified model.
visualization_msgs::MarkerArray effort_markers(const ComparedMotion& motion, const Frame& measured,
                                               const Frame& model, const MessageContext& context,
                                               const MarkerStyle& style);

}  // namespace codesign
