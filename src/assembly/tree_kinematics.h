// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ASSEMBLY_TREE_KINEMATICS_H_
#define MECHANISM_CODESIGN_ASSEMBLY_TREE_KINEMATICS_H_

#include <vector>

#include "mechanism/constants.h"
#include "mechanism/pose.h"
#include "system/state.h"
#include "system/system.h"

namespace codesign {

/// Where the coordinates theta of each tree joint stand: one for revolute, continuous and prismatic joints, three for planar (x, y, turn),
/// six for floating ones (translation, then turns about x, y, z that carry on from JointDescription::start_rotation; where they are zero
/// their rates are the angular velocity in the joint frame), none for fixed ones.
struct TreeLayout {
  std::vector<int> joint_order;  ///< tree joints, parents before children
  std::vector<int> offset;       ///< per joint of the description: first coordinate
  int size = 0;                  ///< number of coordinates

  explicit TreeLayout(const RobotDescription& robot);
};

/// The directions in a planar joint's plane along which it slides, in the joint frame.
template <class T>
struct PlaneAxes {
  Vector3<T> x, y;
};

template <class T>
PlaneAxes<T> plane_axes(const JointDescription& joint, const std::vector<T>& parameters) {
  const Vector3<T> z = axis_at(joint.axis, parameters), x = transverse_axis<T>(z, std::nullopt);
  return {x, cross(z, x)};
}

/// How many coordinates a joint of the tree has.
int coordinates_of(JointType type);

/// Pose and twist of a link frame in the ground frame.
template <class T>
struct LinkMotion {
  Pose<T> X;
  Vector3<T> omega = Vector3<T>::Zero(), velocity = Vector3<T>::Zero();  ///< of the link's origin
};

/// Forward kinematics of the URDF tree: motions of all links at theta and its rate.
template <class T>
std::vector<LinkMotion<T>> link_motions(const RobotDescription& robot, const TreeLayout& layout, const std::vector<T>& parameters,
                                        const VectorX<T>& theta, const VectorX<T>& theta_rate);

/// What one coordinate's unit rate makes of everything that hangs on its joint, in ground axes.
struct CoordinateTwist {
  Vector3<double> omega, velocity;  ///< of the point
  Vector3<double> point;            ///< the origin of the joint's child
};

/// Per coordinate, at theta and the links' poses there.
std::vector<CoordinateTwist> coordinate_twists(const RobotDescription& robot, const TreeLayout& layout,
                                               const std::vector<double>& parameters, const VectorX<double>& theta,
                                               const std::vector<LinkMotion<double>>& links);

/// Centroidal coordinates and velocities of the bodies that hang on these links.
template <class T>
void body_coordinates(const System& system, const Constants<T>& constants, const std::vector<LinkMotion<T>>& links, VectorX<T>* q,
                      VectorX<T>* v);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ASSEMBLY_TREE_KINEMATICS_H_
