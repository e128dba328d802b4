// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_SCENE_LAYOUT_H_
#define MECHANISM_CODESIGN_ROS_SCENE_LAYOUT_H_

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "ros/friction_markers.h"

namespace codesign {

/// Placement and scales for showing two runs of a mechanism together in rviz.
struct SceneLayout {
  double size = 0.0;          ///< largest extent of a mechanism [m]
  double separation = 0.0;    ///< distance of the second mechanism from the first one, along -y [m], if they stand side by side
  double label_height = 0.0;  ///< height of their labels above the root link [m]
  double label_size = 0.0;    ///< height of the letters [m]
  MarkerStyle style;
};

/// A layout in which two mechanisms do not overlap, an arrow of the root-mean-square friction is a third as long as the mechanism, and
/// the largest arrow at most as long as the mechanism.
SceneLayout lay_out(const std::vector<const std::vector<Frame>*>& runs);

/// The transform from `world` to a frame at (0, y, 0), for tf_static.
geometry_msgs::TransformStamped place_in_world(const std::string& frame, double y, const ros::Time& stamp);

/// A text above the origin of a frame. @param name its namespace.
visualization_msgs::Marker label(const std::string& name, const std::string& frame, const std::string& text, const SceneLayout& layout,
                                 const ros::Time& stamp);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_SCENE_LAYOUT_H_
