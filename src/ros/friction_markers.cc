// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/friction_markers.h"

namespace codesign {
namespace {

geometry_msgs::Point to_point(const Eigen::Vector3d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

std_msgs::ColorRGBA color_of(bool is_torque) {
  std_msgs::ColorRGBA color;
  color.r = is_torque ? 0.1F : 0.9F;
  color.g = is_torque ? 0.7F : 0.05F;
  color.b = is_torque ? 0.9F : 0.25F;
  color.a = 1.0F;
  return color;
}

}  // namespace

visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double shaft_diameter) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::ARROW;
  marker.action = along.norm() > shaft_diameter ? visualization_msgs::Marker::ADD : visualization_msgs::Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  marker.points = {to_point(from), to_point(from + along)};
  marker.scale.x = shaft_diameter;
  marker.scale.y = 2.5 * shaft_diameter;
  marker.scale.z = 3.0 * shaft_diameter;
  return marker;
}
visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame, const MessageContext& context,
                                                 const MarkerStyle& style) {
  visualization_msgs::MarkerArray message;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    const FrictionSample& sample = frame.frictions[i];
    const bool is_torque = names.friction_is_torque[i];
    const Eigen::Vector3d along = is_torque ? style.metres_per_newton_metre * sample.torque : style.metres_per_newton * sample.force;
    visualization_msgs::Marker marker = arrow_marker(sample.position, along, style.shaft_diameter);
    marker.header.stamp = context.stamp;
    marker.header.frame_id = context.root_frame;
    marker.ns = names.frictions[i];
    marker.color = color_of(is_torque);
    message.markers.push_back(marker);
  }
  return message;
}

}  // namespace codesign
