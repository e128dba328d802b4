// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_FRAME_H_
#define MECHANISM_CODESIGN_FRAME_H_

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace codesign {

/// A scalar joint at one instant, in URDF's sense of position (multi-turn for continuous joints).
struct JointSample {
  double position = 0.0;      ///< [rad or m]
  double velocity = 0.0;      ///< [rad/s or m/s]
  double acceleration = 0.0;  ///< [rad/s^2 or m/s^2]
  double effort = 0.0;        ///< what the controllers apply [N m or N]
};

/// Friction in one joint or loop.
struct FrictionSample {
  /// On the child along the joint axis, against the motion: -S(v) N [N or N m]. Where a contact slips in several directions (table, planar
  /// and spherical joints), along the direction of its slip: minus the magnitude.
  double friction = 0.0;
  double normal_force = 0.0;      ///< N [N]
  double sliding_velocity = 0.0;  ///< of the child relative to the parent along the joint axis, or the speed of the slip [m/s or rad/s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the joint, in the world [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();     ///< on the child link at `position`, in the world [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();    ///< on the child link, in the world [N m]
};

struct ControllerSample {
  double setpoint = 0.0, input = 0.0, error = 0.0, integral = 0.0, output = 0.0;
};

struct LinkSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the link frame, in the world [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Names of what a Frame holds, in the same order.
struct FrameNames {
  std::vector<std::string> joints;     ///< every one-coordinate joint of the tree (passive and massless ones too), then of the loops
  std::size_t tree_joints = 0;         ///< how many of `joints` belong to the URDF tree
  std::vector<std::string> frictions;  ///< joints and loops with friction
  std::vector<bool> friction_is_torque;
  std::vector<std::string> controllers;
  std::vector<std::string> loops;
  std::vector<std::string> links;  ///< every link of the URDF, the root first
  /// Links that robot_state_publisher cannot place from joint positions (below a planar or floating joint): index, and its parent's index.
  std::vector<std::pair<std::size_t, std::size_t>> free_links;
  std::vector<std::string> signals;  ///< as they were written
};

/// Everything observable at one instant.
struct Frame {
  double time = 0.0;  ///< [s]
  std::vector<JointSample> joints;
  std::vector<FrictionSample> frictions;
  std::vector<ControllerSample> controllers;
  std::vector<double> loop_errors;  ///< largest |Phi| among the rows of each loop [m or -]
  std::vector<LinkSample> links;
  std::vector<double> signals;  ///< those asked for
  double objective = 0.0;       ///< the integral terms so far
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_FRAME_H_
