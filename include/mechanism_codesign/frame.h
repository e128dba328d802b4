// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace codesign {

/// A one-coordinate joint at one instant. The position is zero where URDF has its zero; turning
/// joints count whole turns.
struct JointSample {
  double position = 0.0;      ///< [rad or m]
  double velocity = 0.0;      ///< [rad/s or m/s]
  double acceleration = 0.0;  ///< [rad/s^2 or m/s^2]
  /// of all controllers, within the actuator's limit (13c), positive along the coordinate [N m or
  /// N]
  double effort = 0.0;
};

/// Friction in one joint or loop, or the forces of a contact of two bodies, whose sample is last.
struct FrictionSample {
  /// Friction on the child along the joint axis, -L of doc/theory.md (13) [N or N m]: negative for
  /// positive velocity. For a contact that slips in several directions (table, planar and spherical
  /// joints), minus the magnitude of (13a); of a contact of two bodies minus that of (13m).
  double friction = 0.0;
  double normal_force = 0.0;  ///< N of theory (12), or of all points, (13l) [N]
  /// of the child relative to the parent along the joint axis, or the speed of slip [m/s or rad/s]
  double sliding_velocity = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< the joint's point, in world axes [m]
  /// on the child link at `position`, in world axes [N]; of a contact with its normal force, on the
  /// link that touches with its points
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< on the child link, in world axes [N m]
};

/// A controller at one instant, doc/theory.md (C1)-(C8); setpoint, input and error in the unit of
/// its input signal.
struct ControllerSample {
  double setpoint = 0.0, input = 0.0, error = 0.0;  ///< r, x, e = r - x
  double integral = 0.0;  ///< integral of the error over time; 0 for a controller without one
  double output = 0.0;  ///< u [N or N m] along the driven joint, before the actuator's limit (13c)
};

/// Pose of a link frame in the world, which is the frame of the root link.
struct LinkSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< of the origin [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< link axes to world axes
};

/// The names of the entries of a Frame's vectors, in the same order; the same for all frames of a
/// run.
struct FrameNames {
  /// every one-coordinate joint of the tree (passive and massless ones too), then of the loops
  std::vector<std::string> joints;
  /// number of `joints` that belong to the URDF tree; they come first
  std::size_t tree_joints = 0;
  std::vector<std::string> frictions;  ///< joints and loops with friction, then contacts
  /// per entry of `frictions`: whether the friction is a torque [N m], else a force [N]
  std::vector<bool> friction_is_torque;
  std::vector<std::string> controllers;
  std::vector<std::string> loops;
  std::vector<std::string> links;  ///< every link of the URDF, the root first
  /// Links that robot_state_publisher cannot place from joint positions, those below a planar or
  /// floating joint: (index in `links`, index of the parent link).
  std::vector<std::pair<std::size_t, std::size_t>> free_links;
  std::vector<std::string> signals;  ///< the requested signals, as spelled in the request
};

/// All observed quantities of a run at one instant.
struct Frame {
  double time = 0.0;  ///< [s]
  std::vector<JointSample> joints;
  std::vector<FrictionSample> frictions;
  std::vector<ControllerSample> controllers;
  std::vector<double> loop_errors;  ///< per loop: largest |Phi| of its rows [m or -]
  std::vector<LinkSample> links;
  std::vector<double> signals;  ///< values of FrameNames::signals
  double objective = 0.0;       ///< integral of the objective's integrand from 0 to `time`
};

}  // namespace codesign
