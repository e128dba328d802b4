// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <mechanism_codesign/Scene.h>
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <string>
#include <vector>

#include "mechanism_codesign/frame.h"
#include "ros/scene/markers.h"
#include "ros/scene/scene_view.h"

namespace codesign {

/// A run to show.
struct ShownRun {
  const FrameNames& names;
  const std::vector<Frame>& frames;
  /// solids of its links, in the order of `names`; null: not known
  std::shared_ptr<const LinkBoxes> solids;
};

/// Placement and scales for showing runs of a mechanism in rviz. Places are in the axes of the root
/// link [m].
struct SceneLayout {
  /// largest side of the box around the links and their solids over the runs [m]
  double size = 0.0;
  /// points of links, solids and arrows over the runs, which must all be visible
  std::vector<Eigen::Vector3d> points;
  double floor = 0.0;  ///< height of the lowest solid [m]
  SceneView view;
  /// from the first mechanism to the second, so that their pictures do not overlap
  Eigen::Vector3d apart = Eigen::Vector3d::Zero();
  double letter = 0.0;  ///< height of the letters of the text above all [m]
  MarkerStyle style;    ///< without solids, which differ between designs
  bool has_forces = false, has_torques = false;  ///< whether friction arrows of that kind are drawn
};

/// The layout of runs of the same mechanism. An arrow of the median friction is a sixth as long as
/// the mechanism, rounded down to two digits of metres per newton; arrows longer than 0.4 times the
/// mechanism are cut. Solids of the root, such as a floor, count as far as half a size around the
/// links that move.
SceneLayout lay_out(const std::vector<ShownRun>& runs);

/// A view of mechanisms, with room for a text above them.
struct Stage {
  mechanism_codesign::Scene scene;  ///< without header
  /// middle of the text's first line, at the top of the picture [m]
  Eigen::Vector3d caption = Eigen::Vector3d::Zero();
  /// place of a mechanism's name, above it in the picture, relative to its root link [m]
  Eigen::Vector3d label = Eigen::Vector3d::Zero();
  double letter = 0.0;  ///< height of the letters of names [m]
};

/// @param places of the root links. @param lines number of lines of the text; 0: none.
Stage stage_of(const SceneLayout& layout, const std::vector<Eigen::Vector3d>& places, int lines);

/// The legend of the arrows: a line for each kind that is drawn, in its color, with its scale.
std::vector<CaptionLine> arrow_legend(const SceneLayout& layout);

/// A line in black.
CaptionLine plain_line(const std::string& text);

/// Lines one below the other in the picture. @param first middle of the first one, in the frame of
/// the context.
visualization_msgs::MarkerArray caption(const std::vector<CaptionLine>& lines,
                                        const SceneLayout& layout, const Eigen::Vector3d& first,
                                        const MessageContext& context);

/// The transform from `world` to a frame, for tf_static.
geometry_msgs::TransformStamped place_in_world(const std::string& frame,
                                               const Eigen::Vector3d& place,
                                               const ros::Time& stamp);

/// A text that faces the viewer, black, without header. @param letter height of its letters [m].
visualization_msgs::Marker text_marker(const std::string& text, const Eigen::Vector3d& place,
                                       double letter);

/// A text above the mechanism in a frame. @param name its namespace.
visualization_msgs::Marker label(const std::string& name, const std::string& frame,
                                 const std::string& text, const Stage& stage,
                                 const ros::Time& stamp);

}  // namespace codesign
