// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "mechanism/pose.h"

namespace codesign {

/// The two unit directions along which a planar joint slides, in the joint frame.
template <class T>
struct PlaneAxes {
  Vector3<T> x, y;
};

template <class T>
PlaneAxes<T> plane_axes(const JointDescription& joint, const std::vector<T>& parameters) {
  const Vector3<T> z = axis_at(joint.axis, parameters), x = transverse_axis<T>(z, std::nullopt);
  return {x, cross(z, x)};
}

/// Calls visit(turns, axis) for each coordinate of a joint in turn: whether it turns about the unit vector `axis`, else it slides along
/// it. Axes are those at zero position in the joint frame. Of joints of other types than revolute, continuous, prismatic, planar (two
/// slides, then a turn) and floating (three slides, then turns about x, y and z) none.
template <class T, class Visit>
void visit_steps(const JointDescription& joint, const std::vector<T>& parameters, const Visit& visit) {
  if (joint.type == JointType::kFloating) {
    for (bool turns : {false, true})
      for (int k = 0; k < 3; ++k) visit(turns, Vector3<T>(Vector3<T>::Unit(k)));
    return;
  }
  if (!has_one_coordinate(joint.type) && joint.type != JointType::kPlanar) return;
  const Vector3<T> axis = axis_at(joint.axis, parameters);
  if (joint.type == JointType::kPlanar) {
    const PlaneAxes<T> plane = plane_axes(joint, parameters);
    visit(false, plane.x);
    visit(false, plane.y);
  }
  visit(joint.type != JointType::kPrismatic, axis);
}

}  // namespace codesign
