// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/friction_markers.h"

#include <algorithm>
#include <cmath>

#include "ros/way_out.h"

namespace codesign {
namespace {

geometry_msgs::Point to_point(const Eigen::Vector3d& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

/// The direction in which an arrow moves. Force: at a right angle to it, as much towards the viewer as possible. Torque: along its axis,
/// towards the viewer.
Eigen::Vector3d way_of(const Eigen::Vector3d& along, bool is_torque, const Eigen::Vector3d& towards_viewer) {
  const Eigen::Vector3d unit = along.normalized();
  if (is_torque) return unit.dot(towards_viewer) >= 0.0 ? unit : Eigen::Vector3d(-unit);
  const Eigen::Vector3d sideways = towards_viewer - unit.dot(towards_viewer) * unit;
  return sideways.norm() > 0.1 ? Eigen::Vector3d(sideways.normalized()) : unit;
}

}  // namespace

std_msgs::ColorRGBA friction_color(bool is_torque) {
  std_msgs::ColorRGBA color;
  color.r = is_torque ? 0.1F : 0.9F;
  color.g = is_torque ? 0.7F : 0.05F;
  color.b = is_torque ? 0.9F : 0.25F;
  color.a = 1.0F;
  return color;
}

ArrowEnds friction_arrow(const FrictionSample& sample, bool is_torque, const Frame& frame, const MarkerStyle& style) {
  Eigen::Vector3d along = is_torque ? style.metres_per_newton_metre * sample.torque : style.metres_per_newton * sample.force;
  if (std::isfinite(along.norm()) && along.norm() > style.longest) along *= style.longest / along.norm();
  Eigen::Vector3d from = sample.position;
  const double length = along.norm();
  if (!style.solids || !std::isfinite(length) || length <= style.shaft_diameter) return {from, from + along};
  const Eigen::Vector3d way = way_of(along, is_torque, style.towards_viewer);
  // A torque takes its length along the way: a gap between two solids does not hold it.
  const double out = way_out(from, way, frame, *style.solids, is_torque ? length : style.shaft_diameter);
  // Half of the arrow's head beside the solid.
  if (out > 0.0) from += (out + (is_torque ? 0.0 : 1.5 * style.shaft_diameter)) * way;
  if (is_torque && along.dot(way) < 0.0) from -= along;
  return {from, from + along};
}

visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along, double shaft_diameter) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::ARROW;
  marker.action = along.norm() > shaft_diameter ? visualization_msgs::Marker::ADD : visualization_msgs::Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  marker.points = {to_point(from), to_point(from + along)};
  marker.scale.x = shaft_diameter;
  marker.scale.y = 2.5 * shaft_diameter;
  marker.scale.z = std::min(3.0 * shaft_diameter, 0.5 * along.norm());
  return marker;
}

visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame, const MessageContext& context,
                                                 const MarkerStyle& style) {
  visualization_msgs::MarkerArray message;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    const FrictionSample& sample = frame.frictions[i];
    const bool is_torque = names.friction_is_torque[i];
    const ArrowEnds ends = friction_arrow(sample, is_torque, frame, style);
    visualization_msgs::Marker marker = arrow_marker(ends.from, ends.to - ends.from, style.shaft_diameter);
    marker.header.stamp = context.stamp;
    marker.header.frame_id = context.root_frame;
    marker.ns = names.frictions[i];
    marker.color = friction_color(is_torque);
    message.markers.push_back(marker);
  }
  return message;
}

}  // namespace codesign
