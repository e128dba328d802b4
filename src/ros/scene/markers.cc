// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/markers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/comparison/compared_motion.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Interval = std::pair<double, double>;

/// The part of the ray from + s * along that lies in the box, s >= 0; empty (first > second) if
/// none does.
Interval inside(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                const Eigen::Vector3d& half) {
  Interval part{0.0, std::numeric_limits<double>::infinity()};
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (std::abs(along[k]) < 1e-12) {
      if (std::abs(from[k]) > half[k]) return {1.0, 0.0};
      continue;
    }
    const double one = (-half[k] - from[k]) / along[k], other = (half[k] - from[k]) / along[k];
    part.first = std::max(part.first, std::min(one, other));
    part.second = std::min(part.second, std::max(one, other));
  }
  return part;
}

/// The direction in which an arrow moves. Force: at a right angle to it, as much towards the viewer
/// as possible. Torque: along its axis, towards the viewer.
Eigen::Vector3d way_of(const Eigen::Vector3d& along, bool is_torque,
                       const Eigen::Vector3d& towards_viewer) {
  const Eigen::Vector3d unit = along.normalized();
  if (is_torque) return unit.dot(towards_viewer) >= 0.0 ? unit : Eigen::Vector3d(-unit);
  const Eigen::Vector3d sideways = towards_viewer - unit.dot(towards_viewer) * unit;
  return sideways.norm() > 0.1 ? Eigen::Vector3d(sideways.normalized()) : unit;
}

std_msgs::ColorRGBA rgba(float red, float green, float blue, float alpha) {
  std_msgs::ColorRGBA result;
  result.r = red;
  result.g = green;
  result.b = blue;
  result.a = alpha;
  return result;
}

std_msgs::ColorRGBA model_color() { return rgba(0.1F, 0.65F, 0.25F, 1.0F); }
std_msgs::ColorRGBA measured_color(float alpha) { return rgba(0.3F, 0.3F, 0.35F, alpha); }

/// The displacement of both arrows along the axis, so that the solids do not hide the arrow of the
/// model: it begins outside of the solids, or ends there if it points away from the viewer. @param
/// length of the model's arrow, along the axis.
Eigen::Vector3d outside(const Eigen::Vector3d& from, const Eigen::Vector3d& axis, double length,
                        const Frame& frame, const MarkerStyle& style) {
  const Eigen::Vector3d way = axis.dot(style.towards_viewer) >= 0.0 ? axis : Eigen::Vector3d(-axis);
  // A gap between two solids that is shorter than the arrow does not hold it.
  const double clearance = std::isfinite(length) ? std::max(style.shaft_diameter, std::abs(length))
                                                 : style.shaft_diameter;
  const double out = way_out(from, way, frame, *style.solids, clearance);
  const bool points_away = std::isfinite(length) && length * axis.dot(way) < 0.0;
  return out * way - (points_away ? Eigen::Vector3d(length * axis) : Eigen::Vector3d::Zero());
}

}  // namespace

std_msgs::Header header_of(const MessageContext& context) {
  std_msgs::Header header;
  header.stamp = context.stamp;
  header.frame_id = context.root_frame;
  return header;
}

double way_out(const Eigen::Vector3d& from, const Eigen::Vector3d& along, const Frame& frame,
               const LinkBoxes& boxes, double clearance) {
  std::vector<Interval> parts;
  for (std::size_t k = 0; k < boxes.size() && k < frame.links.size(); ++k) {
    const Eigen::Quaterniond to_link = frame.links[k].orientation.conjugate();
    for (const SolidBox& box : boxes[k]) {
      const Eigen::Vector3d in_link = to_link * (from - frame.links[k].position);
      const Interval part = inside(box.pose.inverse() * in_link,
                                   box.pose.linear().transpose() * (to_link * along), box.half);
      if (part.first <= part.second) parts.push_back(part);
    }
  }
  std::sort(parts.begin(), parts.end());
  double reached = 0.0;
  for (const Interval& part : parts)
    if (part.first <= reached + clearance) reached = std::max(reached, part.second);
  return reached;
}

std_msgs::ColorRGBA friction_color(bool is_torque) {
  return is_torque ? rgba(0.1F, 0.7F, 0.9F, 1.0F) : rgba(0.9F, 0.05F, 0.25F, 1.0F);
}

ArrowEnds friction_arrow(const FrictionSample& sample, bool is_torque, const Frame& frame,
                         const MarkerStyle& style) {
  Eigen::Vector3d along = is_torque ? style.metres_per_newton_metre * sample.torque
                                    : style.metres_per_newton * sample.force;
  if (std::isfinite(along.norm()) && along.norm() > style.longest)
    along *= style.longest / along.norm();
  Eigen::Vector3d from = sample.position;
  const double length = along.norm();
  if (!style.solids || !std::isfinite(length) || length <= style.shaft_diameter)
    return {from, from + along};
  const Eigen::Vector3d way = way_of(along, is_torque, style.towards_viewer);
  // A torque takes its length along the way: a gap between two solids does not hold it.
  const double out =
      way_out(from, way, frame, *style.solids, is_torque ? length : style.shaft_diameter);
  // Half of the arrow's head beside the solid.
  if (out > 0.0) from += (out + (is_torque ? 0.0 : 1.5 * style.shaft_diameter)) * way;
  if (is_torque && along.dot(way) < 0.0) from -= along;
  return {from, from + along};
}

visualization_msgs::Marker arrow_marker(const Eigen::Vector3d& from, const Eigen::Vector3d& along,
                                        double shaft_diameter) {
  visualization_msgs::Marker marker;
  marker.type = visualization_msgs::Marker::ARROW;
  marker.action = along.norm() > shaft_diameter ? visualization_msgs::Marker::ADD
                                                : visualization_msgs::Marker::DELETE;
  marker.pose.orientation.w = 1.0;
  marker.points = {xyz<geometry_msgs::Point>(from), xyz<geometry_msgs::Point>(from + along)};
  marker.scale.x = shaft_diameter;
  marker.scale.y = 2.5 * shaft_diameter;
  marker.scale.z = std::min(3.0 * shaft_diameter, 0.5 * along.norm());
  return marker;
}

visualization_msgs::MarkerArray friction_markers(const FrameNames& names, const Frame& frame,
                                                 const MessageContext& context,
                                                 const MarkerStyle& style) {
  visualization_msgs::MarkerArray message;
  for (std::size_t i = 0; i < frame.frictions.size(); ++i) {
    const FrictionSample& sample = frame.frictions[i];
    const bool is_torque = names.friction_is_torque[i];
    const ArrowEnds ends = friction_arrow(sample, is_torque, frame, style);
    visualization_msgs::Marker marker =
        arrow_marker(ends.from, ends.to - ends.from, style.shaft_diameter);
    marker.header = header_of(context);
    marker.ns = names.frictions[i];
    marker.color = friction_color(is_torque);
    message.markers.push_back(marker);
  }
  return message;
}

MarkerStyle effort_style(const ComparedMotion& motion, double size) {
  double largest_force = 0.0, largest_torque = 0.0;
  for (const ComparedRecording& recording : motion.recordings)
    for (const std::vector<Frame>* frames : {&recording.measured, &recording.model})
      for (const Frame& frame : *frames)
        for (const ComparedJoint& joint : motion.joints) {
          double& largest = joint.is_torque ? largest_torque : largest_force;
          const double effort = std::abs(frame.joints[joint.joint].effort);
          if (effort > largest) largest = effort;
        }
  MarkerStyle style;
  style.shaft_diameter = 0.012 * size;
  if (largest_force > 0.0) style.metres_per_newton = 0.5 * size / largest_force;
  if (largest_torque > 0.0) style.metres_per_newton_metre = 0.5 * size / largest_torque;
  return style;
}

std::vector<CaptionLine> effort_legend(const MarkerStyle& style, const ComparedMotion& motion) {
  std::string scales;
  const auto add = [&](bool is_torque, double scale, const char* unit) {
    const auto has = [&](const ComparedJoint& joint) { return joint.is_torque == is_torque; };
    if (std::any_of(motion.joints.begin(), motion.joints.end(), has))
      scales += ", " + readable(scale, 2) + unit;
  };
  add(false, style.metres_per_newton, " m per N");
  add(true, style.metres_per_newton_metre, " m per N m");
  if (scales.empty()) return {};
  return {{"effort of the model" + scales, model_color()},
          {"effort measured", measured_color(1.0F)}};
}

visualization_msgs::MarkerArray effort_markers(const ComparedMotion& motion, const Frame& measured,
                                               const Frame& model, const MessageContext& context,
                                               const MarkerStyle& style) {
  visualization_msgs::MarkerArray message;
  for (const ComparedJoint& joint : motion.joints) {
    const LinkSample& link = model.links[joint.link];
    const Eigen::Vector3d axis = link.orientation * joint.axis;
    // Beside the axis, since the arrow of the friction lies on the axis.
    Eigen::Vector3d from = link.position + 4.0 * style.shaft_diameter * axis.unitOrthogonal();
    const double scale = joint.is_torque ? style.metres_per_newton_metre : style.metres_per_newton;
    if (style.solids)
      from += outside(from, axis, scale * model.joints[joint.joint].effort, model, style);
    const auto add = [&](const std::string& side, double effort, double thickness,
                         const std_msgs::ColorRGBA& colored) {
      message.markers.push_back(
          arrow_marker(from, scale * effort * axis, thickness * style.shaft_diameter));
      visualization_msgs::Marker& marker = message.markers.back();
      marker.header = header_of(context);
      marker.ns = motion.names.joints[joint.joint] + "/" + side;
      marker.color = colored;
    };
    add("identified", model.joints[joint.joint].effort, 1.0, model_color());
    add("measured", measured.joints[joint.joint].effort, 2.2, measured_color(0.45F));
  }
  return message;
}

}  // namespace codesign
