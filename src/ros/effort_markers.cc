// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/effort_markers.h"

#include <algorithm>
#include <cmath>

#include "ros/way_out.h"
#include "text/number_text.h"

namespace codesign {
namespace {

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

/// The displacement of both arrows along the axis, so that the solids do not hide the arrow of the model: it begins outside of the solids,
/// or ends there if it points away from the viewer. @param length of the model's arrow, along the axis.
Eigen::Vector3d outside(const Eigen::Vector3d& from, const Eigen::Vector3d& axis, double length, const Frame& frame,
                        const MarkerStyle& style) {
  const Eigen::Vector3d way = axis.dot(style.towards_viewer) >= 0.0 ? axis : Eigen::Vector3d(-axis);
  // A gap between two solids that is shorter than the arrow does not hold it.
  const double clearance = std::isfinite(length) ? std::max(style.shaft_diameter, std::abs(length)) : style.shaft_diameter;
  const double out = way_out(from, way, frame, *style.solids, clearance);
  const bool points_away = std::isfinite(length) && length * axis.dot(way) < 0.0;
  return out * way - (points_away ? Eigen::Vector3d(length * axis) : Eigen::Vector3d::Zero());
}

}  // namespace

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
    if (std::any_of(motion.joints.begin(), motion.joints.end(), has)) scales += ", " + readable(scale, 2) + unit;
  };
  add(false, style.metres_per_newton, " m per N");
  add(true, style.metres_per_newton_metre, " m per N m");
  if (scales.empty()) return {};
  return {{"effort of the model" + scales, model_color()}, {"effort measured", measured_color(1.0F)}};
}

visualization_msgs::MarkerArray effort_markers(const ComparedMotion& motion, const Frame& measured, const Frame& model,
                                               const MessageContext& context, const MarkerStyle& style) {
  visualization_msgs::MarkerArray message;
  for (const ComparedJoint& joint : motion.joints) {
    const LinkSample& link = model.links[joint.link];
    const Eigen::Vector3d axis = link.orientation * joint.axis;
    // Beside the axis, since the arrow of the friction lies on the axis.
    Eigen::Vector3d from = link.position + 4.0 * style.shaft_diameter * axis.unitOrthogonal();
    const double scale = joint.is_torque ? style.metres_per_newton_metre : style.metres_per_newton;
    if (style.solids) from += outside(from, axis, scale * model.joints[joint.joint].effort, model, style);
    const auto add = [&](const std::string& side, double effort, double thickness, const std_msgs::ColorRGBA& colored) {
      message.markers.push_back(arrow_marker(from, scale * effort * axis, thickness * style.shaft_diameter));
      visualization_msgs::Marker& marker = message.markers.back();
      marker.header.stamp = context.stamp;
      marker.header.frame_id = context.root_frame;
      marker.ns = motion.names.joints[joint.joint] + "/" + side;
      marker.color = colored;
    };
    add("identified", model.joints[joint.joint].effort, 1.0, model_color());
    add("measured", measured.joints[joint.joint].effort, 2.2, measured_color(0.45F));
  }
  return message;
}

}  // namespace codesign
