// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "description/motion_study.h"
#include "description/robot.h"
#include "mechanism/constants.h"
#include "mechanism/pose.h"
#include "system/state.h"
#include "system/system.h"

namespace codesign {

/// The places of the tree joints' coordinates in theta [rad or m]: each has as many as freedoms
/// (JointFreedoms). Three turns follow JointDescription::start_rotation; where they are zero their
/// rates are the angular velocity in the joint frame.
struct TreeLayout {
  std::vector<int> joint_order;  ///< tree joints, parents before children
  /// per joint of the description: its first coordinate; meaningless for loops
  std::vector<int> offset;
  int size = 0;  ///< number of coordinates
  /// per JointDescription::motor: its coordinate, and that of the joint
  std::vector<std::pair<int, int>> motors;

  explicit TreeLayout(const RobotDescription& robot);
};

/// Pose of a link frame in the ground frame, its angular velocity [rad/s] and the velocity of its
/// origin [m/s], in ground axes.
template <class T>
struct LinkMotion {
  Pose<T> X;
  Vector3<T> omega = Vector3<T>::Zero(), velocity = Vector3<T>::Zero();
};

/// Forward kinematics of the URDF tree: the motions of all links, in the order of the description,
/// at theta and theta_rate.
/// @param links overwritten, its memory is used again.
template <class T>
void link_motions(const RobotDescription& robot, const TreeLayout& layout,
                  const std::vector<T>& parameters, const VectorX<T>& theta,
                  const VectorX<T>& theta_rate, std::vector<LinkMotion<T>>* links);
template <class T>
std::vector<LinkMotion<T>> link_motions(const RobotDescription& robot, const TreeLayout& layout,
                                        const std::vector<T>& parameters, const VectorX<T>& theta,
                                        const VectorX<T>& theta_rate) {
  std::vector<LinkMotion<T>> links;
  link_motions(robot, layout, parameters, theta, theta_rate, &links);
  return links;
}

/// The rigid motion of all links below a joint for the unit rate of one of its coordinates, in
/// ground axes.
struct CoordinateTwist {
  Vector3<double> omega, velocity;  ///< angular velocity; velocity of `point`
  Vector3<double> point;            ///< origin of the joint's child link [m]
};

/// The twist of each coordinate (layout.size) at theta. @param links the result of link_motions()
/// at theta. @param twists overwritten, its memory is used again.
void coordinate_twists(const RobotDescription& robot, const TreeLayout& layout,
                       const std::vector<double>& parameters, const VectorX<double>& theta,
                       const std::vector<LinkMotion<double>>& links,
                       std::vector<CoordinateTwist>* twists);

/// Sets the turns of a state to the tree's coordinates, so that a position beyond one turn is kept;
/// the turns of loops count from zero.
void set_turns(const System& system, const TreeLayout& layout, const VectorX<double>& theta,
               State<double>* state);

/// Centroidal coordinates q and velocities v of all bodies (7 entries each, r and p) for given
/// motions of their links.
template <class T>
void body_coordinates(const System& system, const Constants<T>& constants,
                      const std::vector<LinkMotion<T>>& links, VectorX<T>* q, VectorX<T>* v);

/// Sets the signs in the turns of a state with a forest, so that the largest Euler parameter of
/// each body is positive, as those of body_coordinates(). @param state q must be set.
void set_signs(const System& system, const Constants<double>& constants,
               const std::vector<LinkMotion<double>>& links, State<double>* state);

/// Coordinates q and velocities v of a state (Layout::n entries each) at theta and theta_rate:
/// those of body_coordinates() for free bodies, and those of the tree's joints themselves for
/// bodies of the forest, theory (56). @param links the result of link_motions().
template <class T>
void state_coordinates(const System& system, const TreeLayout& layout,
                       const Constants<T>& constants, const std::vector<LinkMotion<T>>& links,
                       const VectorX<T>& theta, const VectorX<T>& theta_rate, VectorX<T>* q,
                       VectorX<T>* v);

/// The index in RobotDescription::joints of the tree joint that an entry of `initial_state` names;
/// -1 for a loop or an unknown name.
int tree_joint(const RobotDescription& robot, const InitialJointState& initial);

/// The model with what the study's `initial_state` gives of its joints: the rotations of floating
/// ones as their JointDescription::start_rotation, positions and guesses as start_position.
RobotDescription with_start(RobotDescription robot, const MotionStudy& study);

}  // namespace codesign
