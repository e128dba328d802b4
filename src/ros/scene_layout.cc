// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

/// Determines the scale of arrows from the loads that they show.
class ArrowScale {
 public:
  void include(double load) {
    if (load == 0.0) return;
    ++count_;
    sum_of_squares_ += load * load;
    largest_ = std::max(largest_, load);
  }

  /// Arrow length per unit of load: a third of `size` for the root mean square of the loads, and at most `size` for the largest one.
  double metres_per_unit(double size, double fallback) const {
    if (count_ == 0) return fallback;
    return std::min(size / (3.0 * std::sqrt(sum_of_squares_ / count_)), size / largest_);
  }

 private:
  int count_ = 0;
  double sum_of_squares_ = 0.0, largest_ = 0.0;
};

/// The bounding box of all link frames relative to the root link, and the loads to draw.
struct Extent {
  Eigen::AlignedBox3d box{Eigen::Vector3d::Zero()};
  ArrowScale force, torque;

  void include(const std::vector<Frame>& run) {
    for (const Frame& frame : run) {
      for (const LinkSample& link : frame.links) box.extend(link.position - frame.links.front().position);
      for (const FrictionSample& sample : frame.frictions) {
        force.include(sample.force.norm());
        torque.include(sample.torque.norm());
      }
    }
  }
};

}  // namespace

SceneLayout lay_out(const std::vector<const std::vector<Frame>*>& runs) {
  Extent extent;
  for (const std::vector<Frame>* run : runs) extent.include(*run);
  const double size = std::max(extent.box.sizes().maxCoeff(), 1e-3);
  SceneLayout layout;
  layout.size = size;
  layout.separation = extent.box.sizes().y() + 0.5 * size;
  layout.label_height = extent.box.max().z() + 0.15 * size;
  layout.label_size = 0.1 * size;
  layout.style.shaft_diameter = 0.025 * size;
  layout.style.metres_per_newton = extent.force.metres_per_unit(size, layout.style.metres_per_newton);
  layout.style.metres_per_newton_metre = extent.torque.metres_per_unit(size, layout.style.metres_per_newton_metre);
  return layout;
}

geometry_msgs::TransformStamped place_in_world(const std::string& frame, double y, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = "world";
  transform.child_frame_id = frame;
  transform.transform.translation.y = y;
  transform.transform.rotation.w = 1.0;
  return transform;
}

visualization_msgs::Marker label(const std::string& name, const std::string& frame, const std::string& text, const SceneLayout& layout,
                                 const ros::Time& stamp) {
  visualization_msgs::Marker marker;
  marker.header.stamp = stamp;
  marker.header.frame_id = frame;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  marker.text = text;
  marker.pose.position.z = layout.label_height;
  marker.pose.orientation.w = 1.0;
  marker.scale.z = layout.label_size;
  marker.color.a = 1.0F;
  return marker;
}

}  // namespace codesign
