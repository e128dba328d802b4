// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/robot.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/pose.h"

namespace codesign {

struct Topology;
struct Pair;

/// A chain of joints from body i to body j with all joints at zero, in the frame of the base link
/// of body i.
template <class T>
struct ChainGeometry {
  // Elements of the longest chain that turns and slides in all directions.
  static constexpr std::size_t kFew = 6;
  Pose<T> X_ij;                       ///< pose of the base link of body j
  ShortVector<Pose<T>, kFew> frames;  ///< per element: its joint frame
  /// per element: its unit axis, with URDF's sign also for reversed elements
  ShortVector<Vector3<T>, kFew> axes;
};

/// Multiplies the fixed offsets along the chain.
template <class T>
ChainGeometry<T> chain_geometry(const RobotDescription& robot, const Topology& topology,
                                const std::vector<ChainElement>& chain,
                                const std::vector<T>& parameters) {
  ChainGeometry<T> geometry;
  for (const ChainElement& element : chain) {
    const JointDescription& joint = robot.joints[to_index(element.joint)];
    const Pose<T> X_PF = link_in_base(robot, topology.link_base, topology.link_parent_joint,
                                      joint.parent, parameters) *
                         pose_at(joint.origin, parameters);
    const Pose<T> X_CF = link_in_base(robot, topology.link_base, topology.link_parent_joint,
                                      joint.child, parameters) *
                         pose_at(joint.child_origin, parameters);
    const Pose<T> X_iF = geometry.X_ij * (element.reversed ? X_CF : X_PF);
    geometry.frames.push_back(X_iF);
    geometry.axes.push_back(X_iF.R * axis_at(joint.axis, parameters));
    geometry.X_ij = X_iF * (element.reversed ? X_PF : X_CF).inverse();
  }
  return geometry;
}

/// The point on line 1 nearest to line 2. A line passes through o with the unit direction z; the
/// lines must not be parallel.
template <class T>
Vector3<T> nearest_point(const Vector3<T>& o1, const Vector3<T>& z1, const Vector3<T>& o2,
                         const Vector3<T>& z2) {
  const Vector3<T> offset = o2 - o1;
  const T c = dot(z1, z2);
  return o1 + z1 * ((dot(offset, z1) - c * dot(offset, z2)) / (T(1.0) - c * c));
}

/// Joint points, axes, coordinates and coefficients of a pair at `parameters`.
/// @param centre_i, centre_j centres of mass of the two bodies in the frames of their base links
/// [m]; zero for the ground.
/// @param constants overwritten, its memory is used again.
template <class T>
void pair_constants(const RobotDescription& robot, const Topology& topology, const Pair& pair,
                    const Vector3<T>& centre_i, const Vector3<T>& centre_j,
                    const std::vector<T>& parameters, PairConstants<T>* constants);
template <class T>
PairConstants<T> pair_constants(const RobotDescription& robot, const Topology& topology,
                                const Pair& pair, const Vector3<T>& centre_i,
                                const Vector3<T>& centre_j, const std::vector<T>& parameters) {
  PairConstants<T> constants;
  pair_constants(robot, topology, pair, centre_i, centre_j, parameters, &constants);
  return constants;
}

/// Checks that a joint of this kind has the dimensions that its normal forces, theory (12), are
/// computed from: joint_length and joint_width for prismatic joints; joint_length and pin_radius
/// for revolute, continuous and cylindrical ones; pin_radius for spherical ones; none for planar
/// ones. The URDF reader calls this function for ordinary joints, derive_topology() for joints that
/// it folds from a chain.
/// @throws InputError if a dimension is missing, if joints of this type have no friction law, or if
/// a joint that slips in several directions has numbers for motion against the axis.
void check_friction_geometry(const FrictionDescription& friction, PairKind kind,
                             const std::string& element);

}  // namespace codesign
