// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MECHANISM_RIGID_GROUPS_H_
#define MECHANISM_CODESIGN_MECHANISM_RIGID_GROUPS_H_

#include <vector>

#include "mechanism/pose.h"

namespace codesign {

/// Links joined by fixed joints.
struct RigidGroups {
  std::vector<int> link_parent_joint;  ///< per link: the tree joint above it, -1 for the root
  std::vector<int> link_base;          ///< per link: the link of its group that is nearest to the root

  explicit RigidGroups(const RobotDescription& robot);
};

/// Mass, centre and inertia about the centre of links that are rigidly joined, in the frame of their base link. Without mass the centre is
/// the base link's origin.
template <class T>
MassProperties<T> merged_mass(const RobotDescription& robot, const std::vector<int>& link_base, const std::vector<int>& link_parent_joint,
                              const std::vector<int>& links, const std::vector<T>& parameters) {
  MassProperties<T> result;
  std::vector<MassProperties<T>> parts;
  for (int link : links) {
    const auto& inertial = robot.links[static_cast<std::size_t>(link)].inertial;
    if (!inertial) continue;
    const Pose<T> X = link_in_base(robot, link_base, link_parent_joint, link, parameters);
    MassProperties<T> part = mass_properties<T>(*inertial, parameters);
    part.centre = X * part.centre;
    part.inertia = X.R * part.inertia * X.R.transpose();
    result.mass += part.mass;
    result.centre += part.mass * part.centre;
    parts.push_back(part);
  }
  if (is_less(T(0.0), T(result.mass * result.mass), true)) result.centre /= result.mass;
  for (const MassProperties<T>& part : parts) {
    const Vector3<T> offset = part.centre - result.centre;
    result.inertia += part.inertia + part.mass * (dot(offset, offset) * Matrix3<T>::Identity() - offset * offset.transpose());
  }
  return result;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MECHANISM_RIGID_GROUPS_H_
