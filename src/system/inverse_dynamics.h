// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "joints/body_kinematics.h"
#include "math/span.h"
#include "mechanism/constants.h"
#include "mechanism/driven_tree.h"

namespace codesign {

/// The load tau_k that one joint of the tree must exert for given accelerations of all joints, by the Newton-Euler recursion on absolute
/// coordinates; doc/theory.md (C4). No allocation after construction; not thread-safe.
template <class T>
class InverseDynamics {
 public:
  /// @param tree with a driven joint; must outlive this.
  explicit InverseDynamics(const DrivenTree& tree);

  /// The force [N] or torque [N m] along the driven joint's coordinate, positive along it.
  /// @param bodies motion of all bodies, the ground last. @param gravity in ground axes [m/s^2].
  /// @param accelerations of the joints, one per node, or none for (C5): everything at rest, only gravity is balanced.
  /// @param rates of the joints, one per node, read for nodes with a rotor; empty if there are none.
  T load(const Constants<T>& constants, const std::vector<BodyKinematics<T>>& bodies, const Vector3<T>& gravity, In<T> accelerations,
         In<T> rates = {});

 private:
  /// The motion of one body and the levers of its joint, in ground axes.
  struct Motion {
    Vector3<T> omega, omega_rate, acceleration;  ///< angular velocity and acceleration; acceleration of the centre of mass
    Vector3<T> axis, lever_parent, lever;        ///< joint axis; from the parent's centre to the joint, from there to the body's centre
    Vector3<T> force, moment;                    ///< F_b and N_b of (C4), which the motion needs
  };

  /// Motion of a body from the motion of its parent and the acceleration of its joint.
  void move(std::size_t k, const T& acceleration);
  /// F_b and N_b from the motion of a body.
  void weigh(std::size_t k, const Vector3<T>& gravity);
  /// The part of the load that the rotor of joint k needs; theory (C4), last paragraph.
  T rotor_load(std::size_t k) const;

  const DrivenTree::Node& node(std::size_t k) const { return tree_.nodes[k]; }
  std::size_t driven() const { return static_cast<std::size_t>(tree_.driven); }
  const BodyKinematics<T>& body(std::size_t k) const { return (*bodies_)[static_cast<std::size_t>(tree_.nodes[k].body)]; }
  const BodyKinematics<T>& parent_body(std::size_t k) const;
  const JointDynamicsConstants<T>& actuator(std::size_t k) const {
    return constants_->pairs[static_cast<std::size_t>(node(k).pair)].dynamics.front();
  }
  const BodyConstants<T>& mass_of(std::size_t k) const { return constants_->bodies[static_cast<std::size_t>(tree_.nodes[k].body)]; }
  /// The motion of a node's parent; at rest for the ground.
  const Motion& parent_motion(std::size_t k) const;
  /// The joint axis in the parent's body axes.
  Vector3<T> local_axis(std::size_t k) const;

  const DrivenTree& tree_;
  const Constants<T>* constants_ = nullptr;
  const std::vector<BodyKinematics<T>>* bodies_ = nullptr;
  bool moving_ = false;  ///< whether accelerations were given
  std::vector<T> accelerations_, rates_;
  std::vector<Motion> motions_;  ///< one per node, the ground last
};

}  // namespace codesign
