// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_text.h"

#include <cmath>
#include <cstdint>

#include "text/number_text.h"

namespace codesign {
namespace {

visualization_msgs::Marker text_marker(const std::string& text, const Eigen::Vector3d& place, double letter) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = text;
  marker.pose.position.x = place.x();
  marker.pose.position.y = place.y();
  marker.pose.position.z = place.z();
  marker.pose.orientation.w = 1.0;
  marker.scale.z = letter;
  marker.color.a = 1.0F;
  return marker;
}

}  // namespace

std::vector<CaptionLine> arrow_legend(const SceneLayout& layout) {
  std::vector<CaptionLine> lines;
  const std::string cut = std::isfinite(layout.style.longest) ? ", at most " + readable(layout.style.longest, 2) + " m" : "";
  if (layout.has_forces)
    lines.push_back({"friction force, " + readable(layout.style.metres_per_newton, 6) + " m per N" + cut, friction_color(false)});
  if (layout.has_torques)
    lines.push_back({"friction torque, " + readable(layout.style.metres_per_newton_metre, 6) + " m per N m" + cut, friction_color(true)});
  return lines;
}

CaptionLine plain_line(const std::string& text) {
  CaptionLine line{text, {}};
  line.color.a = 1.0F;
  return line;
}

visualization_msgs::MarkerArray caption(const std::vector<CaptionLine>& lines, const SceneLayout& layout, const Eigen::Vector3d& first,
                                        const MessageContext& context) {
  visualization_msgs::MarkerArray message;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const Eigen::Vector3d place = first - 1.6 * static_cast<double>(k) * layout.letter * layout.view.up();
    message.markers.push_back(text_marker(lines[k].text, place, layout.letter));
    visualization_msgs::Marker& marker = message.markers.back();
    marker.header.stamp = context.stamp;
    marker.header.frame_id = context.root_frame;
    marker.ns = "caption";
    marker.id = static_cast<std::int32_t>(k);
    marker.color = lines[k].color;
  }
  return message;
}

geometry_msgs::TransformStamped place_in_world(const std::string& frame, const Eigen::Vector3d& place, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = "world";
  transform.child_frame_id = frame;
  transform.transform.translation.x = place.x();
  transform.transform.translation.y = place.y();
  transform.transform.translation.z = place.z();
  transform.transform.rotation.w = 1.0;
  return transform;
}

visualization_msgs::Marker label(const std::string& name, const std::string& frame, const std::string& text, const Stage& stage,
                                 const ros::Time& stamp) {
  visualization_msgs::Marker marker = text_marker(text, stage.label, stage.letter);
  marker.header.stamp = stamp;
  marker.header.frame_id = frame;
  marker.ns = name;
  return marker;
}

}  // namespace codesign
