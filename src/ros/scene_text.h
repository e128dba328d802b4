// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "ros/scene_layout.h"

namespace codesign {

/// A line of a text, with its color.
struct CaptionLine {
  std::string text;
  std_msgs::ColorRGBA color;
};

/// The legend of the arrows: a line for each kind that is drawn, in its color, with its scale.
std::vector<CaptionLine> arrow_legend(const SceneLayout& layout);

/// A line in black.
CaptionLine plain_line(const std::string& text);

/// Lines one below the other in the picture. @param first middle of the first one, in the frame of the context.
visualization_msgs::MarkerArray caption(const std::vector<CaptionLine>& lines, const SceneLayout& layout, const Eigen::Vector3d& first,
                                        const MessageContext& context);

/// The transform from `world` to a frame, for tf_static.
geometry_msgs::TransformStamped place_in_world(const std::string& frame, const Eigen::Vector3d& place, const ros::Time& stamp);

/// A text above the mechanism in a frame. @param name its namespace.
visualization_msgs::Marker label(const std::string& name, const std::string& frame, const std::string& text, const Stage& stage,
                                 const ros::Time& stamp);

}  // namespace codesign
