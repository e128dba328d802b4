// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "description/robot.h"
#include "math/arrays.h"
#include "math/euler_parameters.h"
#include "mechanism/mass_properties.h"

namespace codesign {

/// The pose X_AB of frame B in frame A: a point s_B in B is R s_B + t in A. t in [m].
template <class T>
struct Pose {
  Matrix3<T> R = Matrix3<T>::Identity();
  Vector3<T> t = Vector3<T>::Zero();

  Pose operator*(const Pose& other) const { return {R * other.R, R * other.t + t}; }
  Vector3<T> operator*(const Vector3<T>& s) const { return R * s + t; }
  Pose inverse() const {
    const Matrix3<T> Rt = R.transpose();
    return {Rt, -(Rt * t)};
  }
};

/// The three components at `parameters`.
template <class T>
Vector3<T> vector_at(const QuantityVector& vector, const std::vector<T>& parameters) {
  return Vector3<T>(vector[0].at(parameters), vector[1].at(parameters), vector[2].at(parameters));
}

/// The pose of a URDF `<origin>`.
template <class T>
Pose<T> pose_at(const PoseDescription& origin, const std::vector<T>& parameters) {
  const Vector3<T> rpy = vector_at(origin.rpy, parameters);
  return {rotation_from_rpy<T>(rpy), vector_at(origin.xyz, parameters)};
}

/// The axis at `parameters`, scaled to unit length.
template <class T>
Vector3<T> axis_at(const QuantityVector& axis, const std::vector<T>& parameters) {
  using std::sqrt;
  const Vector3<T> z = vector_at(axis, parameters);
  return z / sqrt(dot(z, z));
}

/// Pose of a link in the base link of its rigid group, through the fixed joints between them.
template <class T>
Pose<T> link_in_base(const RobotDescription& robot, const std::vector<int>& link_base,
                     const std::vector<int>& link_parent_joint, int link,
                     const std::vector<T>& parameters) {
  Pose<T> pose;
  while (link != link_base[to_index(link)]) {
    const JointDescription& joint = robot.joints[to_index(link_parent_joint[to_index(link)])];
    pose = pose_at(joint.origin, parameters) * pose;
    link = joint.parent;
  }
  return pose;
}

/// The axis x'' normal to the unit vector z: the projection of the preferred direction or, without
/// one, of the coordinate axis that follows the largest component of z in the order x, y, z, x.
template <class T>
Vector3<T> transverse_axis(const Vector3<T>& z,
                           const std::optional<std::array<double, 3>>& preferred) {
  using std::sqrt;
  Vector3<T> x = Vector3<T>::Zero();
  if (preferred) {
    for (int k = 0; k < 3; ++k) x[k] = T((*preferred)[to_index(k)]);
  } else {
    int largest = 0;
    for (int k = 1; k < 3; ++k)
      if (is_less(T(z[largest] * z[largest] + 1e-9), T(z[k] * z[k]), false)) largest = k;
    x[(largest + 1) % 3] = T(1.0);
  }
  x -= dot(x, z) * z;
  return x / sqrt(dot(x, x));
}

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

/// Calls visit(turns, axis) for each freedom of a joint in turn: whether it turns about the unit
/// vector `axis`, else it slides along it. Axes are those at zero position in the joint frame.
template <class T, class Visit>
void visit_freedoms(const JointDescription& joint, const std::vector<T>& parameters,
                    const Visit& visit) {
  const JointFreedoms& freedoms = joint.freedoms();
  std::optional<PlaneAxes<T>> plane;
  for (int k = 0; k < freedoms.size(); ++k) {
    const JointFreedom& freedom = freedoms.each[to_index(k)];
    const bool in_plane =
        freedom.axis == FreedomAxis::kInPlane || freedom.axis == FreedomAxis::kAcross;
    if (in_plane && !plane) plane = plane_axes(joint, parameters);
    if (in_plane)
      visit(freedom.turns, freedom.axis == FreedomAxis::kInPlane ? plane->x : plane->y);
    else if (freedom.axis == FreedomAxis::kAxis)
      visit(freedom.turns, axis_at(joint.axis, parameters));
    else
      visit(freedom.turns, Vector3<T>(Vector3<T>::Unit(static_cast<int>(freedom.axis) -
                                                       static_cast<int>(FreedomAxis::kX))));
  }
}

}  // namespace codesign
