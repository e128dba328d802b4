// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_SYSTEM_INVERSE_DYNAMICS_H_
#define MECHANISM_CODESIGN_SYSTEM_INVERSE_DYNAMICS_H_

#include <vector>

#include "joints/body_kinematics.h"
#include "joints/local_row.h"
#include "mechanism/constants.h"
#include "mechanism/driven_tree.h"
#include "sparse/sparsity.h"

namespace codesign {

/// The load that a joint of the tree must exert for given accelerations of the joints, by the Newton-Euler recursion on absolute
/// coordinates; doc/theory.md (C4). Its gradient is the recursion run backwards, in about three times its cost.
/// No allocation after construction; not thread-safe.
template <class T>
class InverseDynamics {
 public:
  /// @param tree with a driven joint; must outlive this.
  explicit InverseDynamics(const DrivenTree& tree);

  /// Force or torque along the driven joint's coordinate.
  /// @param bodies kinematics of all bodies, the ground last. @param accelerations one per node, or nullptr: everything at rest, so that
  /// gravity alone is balanced. @param rates likewise, of joints that rotors drive; nullptr: there are none.
  T load(const Constants<T>& constants, const std::vector<BodyKinematics<T>>& bodies, const Vector3<T>& gravity, const T* accelerations,
         const T* rates = nullptr);

  /// Appends factor times the gradient of the last load() by positions and velocities.
  /// @param by_acceleration its derivative by the acceleration of each node, not multiplied by the factor; may be nullptr.
  /// @param by_rate likewise by the rates of joints that rotors drive.
  void append_gradient(const T& factor, SparseGradient<T>* gradient, T* by_acceleration, T* by_rate = nullptr);

 private:
  /// One body's motion, and the adjoint of each quantity: the derivative of the load by it.
  struct Motion {
    Vector3<T> omega, omega_rate, acceleration;  ///< in the ground frame
    Vector3<T> axis, lever_parent, lever;        ///< joint axis; from the parent's centre to the joint, from there to the body's centre
    Vector3<T> force, moment;                    ///< that the motion takes
  };
  struct Adjoint {
    Vector3<T> r, v, omega, omega_rate, acceleration, axis, force, moment;
    Matrix3<T> W;  ///< sum of b s^T over b^T A s; theory (3)
  };

  void move(std::size_t k, const T& acceleration);
  void weigh(std::size_t k, const Vector3<T>& gravity);
  /// What the spin of a joint's rotor asks of the driven joint.
  T rotor_load(std::size_t k) const;
  void reverse_sum();
  void reverse_rotor(std::size_t k, T* by_acceleration, T* by_rate);
  void reverse_weigh(std::size_t k);
  void reverse_turn(std::size_t k);
  void reverse_slide(std::size_t k);
  void append_body(std::size_t k, const T& factor, SparseGradient<T>* gradient) const;

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
  /// Where what a node hands to its parent adds up; what goes to the ground is never read.
  Adjoint& parent_adjoint(std::size_t k);
  Vector3<T> local_axis(std::size_t k) const;

  const DrivenTree& tree_;
  const Constants<T>* constants_ = nullptr;
  const std::vector<BodyKinematics<T>>* bodies_ = nullptr;
  bool moving_ = false;
  std::vector<T> accelerations_, rates_;
  std::vector<Motion> motions_;    ///< one per node, the ground last
  std::vector<Adjoint> adjoints_;  ///< likewise
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_SYSTEM_INVERSE_DYNAMICS_H_
