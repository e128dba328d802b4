// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/joint_sweep.h"
#include "math/arrays.h"
#include "mechanism/constants.h"
#include "mechanism/coupling.h"

namespace codesign {

/// The motion of one joint of a driven tree.
template <class T>
struct DrivenJoint {
  JointPose<T> pose;
  /// [rad or m], per s, per s^2; the position is needed of slides only
  T position{0.0}, rate{0.0}, acceleration{0.0};
};

/// The load tau_k that one joint of the tree must exert for given accelerations of all joints, by
/// the two sweeps of joint_sweep.h; doc/theory.md (C4). No allocation after construction; not
/// thread-safe.
template <class T>
class InverseDynamics {
 public:
  /// @param tree with a driven joint that was grown for prescribed accelerations, or without nodes;
  /// must outlive this.
  explicit InverseDynamics(const DrivenTree& tree);

  /// The joint of a node, to be set before load().
  DrivenJoint<T>& joint(std::size_t node) { return joints_[node]; }
  /// The force [N] or torque [N m] along the driven joint's coordinate, positive along it. @param
  /// gravity in ground axes [m/s^2]
  T load(const Constants<T>& constants, const Vector3<T>& gravity);

 private:
  const AxesMotion<T>& parent(std::size_t k) const;

  const DrivenTree& tree_;
  std::vector<DrivenJoint<T>> joints_;  ///< one per node, as below
  std::vector<AxesMotion<T>> motions_;  ///< and the ground last
  std::vector<Wrench<T>> wrenches_;  ///< that joints transmit to the bodies; of moved bodies only
};

/// The load that balances the weight of all bodies that the driven joint moves, with everything at
/// rest; doc/theory.md (C5).
/// @param bodies motion of all bodies, the ground last. @returns as InverseDynamics::load()
template <class T>
T gravity_load(const DrivenTree& tree, const Constants<T>& constants,
               const std::vector<BodyKinematics<T>>& bodies, const Vector3<T>& gravity) {
  T mass(0.0);
  Vector3<T> moment = Vector3<T>::Zero();  // sum of m r
  for (const DrivenTree::Node& node : tree.nodes) {
    if (!node.moved) continue;
    const T& own = constants.bodies[to_index(node.body)].mass;
    mass += own;
    moment += own * bodies[to_index(node.body)].r;
  }
  const DrivenTree::Node& joint = tree.nodes[to_index(tree.driven)];
  const PairConstants<T>& pair = constants.pairs[to_index(joint.pair)];
  const BodyKinematics<T>& base =
      joint.parent < 0 ? bodies.back() : bodies[to_index(tree.nodes[to_index(joint.parent)].body)];
  const Vector3<T> axis = base.A * pair.steps[0].axis, point = base.r + base.A * pair.s_i;
  return -dot<T>(axis, joint.slides ? Vector3<T>(mass * gravity)
                                    : cross<T>(Vector3<T>(moment - mass * point), gravity));
}

}  // namespace codesign
