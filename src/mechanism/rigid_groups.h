// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "math/arrays.h"
#include "mechanism/mass_properties.h"
#include "mechanism/pose.h"

namespace codesign {

/// Groups of links that are joined by fixed joints.
struct RigidGroups {
  std::vector<int> link_parent_joint;  ///< per link: the tree joint above it, -1 for the root
  /// per link: the base link of its group, which is the nearest to the root
  std::vector<int> link_base;

  explicit RigidGroups(const RobotDescription& robot);
};

/// Poses of links in the base links of their rigid groups at one design, each computed once. The
/// same as link_in_base() to the last bit for up to kWalk fixed joints in a row; longer chains go
/// on from a pose that is known, so that their cost grows with their length only.
template <class T>
class LinkPoses {
 public:
  /// Begins a new design.
  void start(std::size_t links) {
    known_.assign(links, false);
    poses_.resize(links);
  }
  const Pose<T>& of(const RobotDescription& robot, const std::vector<int>& link_base,
                    const std::vector<int>& link_parent_joint, int link,
                    const std::vector<T>& parameters) {
    const auto place = to_index(link);
    if (known_[place]) return poses_[place];
    Pose<T> pose;
    for (int steps = 0; link != link_base[to_index(link)]; ++steps) {
      if (steps == kWalk) {
        pose = of(robot, link_base, link_parent_joint, link, parameters) * pose;
        break;
      }
      const JointDescription& joint = robot.joints[to_index(link_parent_joint[to_index(link)])];
      pose = pose_at(joint.origin, parameters) * pose;
      link = joint.parent;
    }
    known_[place] = true;
    return poses_[place] = pose;
  }

 private:
  static constexpr int kWalk = 100;
  std::vector<bool> known_;
  std::vector<Pose<T>> poses_;
};

/// What merged_mass() adds up, kept so that a later call allocates nothing.
template <class T>
struct MassWorkspace {
  std::vector<MassProperties<T>> links, solids;
  LinkPoses<T> poses;  ///< at the parameters of the call; to be started by the caller
};

/// Mass, centre of mass and inertia about it of `links`, which form one group, in the frame of
/// their base link. If the mass is zero, the centre is the origin of the base link. @param
/// workspace overwritten but for its poses, which must belong to `parameters`.
template <class T>
MassProperties<T> merged_mass(const RobotDescription& robot, const std::vector<int>& link_base,
                              const std::vector<int>& link_parent_joint,
                              const std::vector<int>& links, const std::vector<T>& parameters,
                              MassWorkspace<T>* workspace) {
  MassProperties<T> result;
  std::vector<MassProperties<T>>& parts = workspace->links;
  parts.clear();
  for (int link : links) {
    const auto& inertial = robot.links[to_index(link)].inertial;
    if (!inertial) continue;
    const Pose<T>& X = workspace->poses.of(robot, link_base, link_parent_joint, link, parameters);
    MassProperties<T> part = mass_properties<T>(*inertial, parameters, &workspace->solids);
    part.centre = X * part.centre;
    part.inertia = X.R * part.inertia * X.R.transpose();
    result.mass += part.mass;
    result.centre += part.mass * part.centre;
    parts.push_back(part);
  }
  if (is_less(T(0.0), T(result.mass * result.mass), true)) result.centre /= result.mass;
  for (const MassProperties<T>& part : parts) {
    const Vector3<T> offset = part.centre - result.centre;
    result.inertia += part.inertia + part.mass * (dot(offset, offset) * Matrix3<T>::Identity() -
                                                  offset * offset.transpose());
  }
  return result;
}

}  // namespace codesign
