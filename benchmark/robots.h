// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "benchmark/mechanisms.h"

namespace codesign {

/// A link and the joint on which it hangs.
struct RobotLink {
  std::string name;
  int parent;   ///< index of the parent's link; -1: the base, which does not move
  char axis;    ///< 'x', 'y' or 'z' of the joint frame
  bool slides;  ///< along the axis; else it turns about it
  std::array<double, 3> origin, rpy;  ///< joint frame in the parent's frame at position 0 [m, rad]
  double mass;                        ///< [kg]
  std::array<double, 3> centre,
      box;  ///< centre of mass [m]; edges of the homogeneous box with the link's inertia [m]
  double damping, friction;  ///< as in URDF's <dynamics>
  double position;           ///< at the start, where all joints are at rest [rad or m]
};

/// Moments of inertia of the link's box about its centre, along its edges [kg m^2].
std::array<double, 3> inertia(const RobotLink& link);

/// A robot that falls from a bent posture, its base fixed and its motors off.
struct Robot {
  std::string name;
  double duration;  ///< [s]
  double error;     ///< at which codes are compared: of any joint position [rad or m]
  std::vector<RobotLink> links;

  bool is_stiff() const;  ///< whether joints have dry friction
};

/// Robots with the arrangement of joints of well-known ones; all numbers are our own, rounded and
/// plausible.
Robot ur5();
Robot panda();
Robot atlas();
Robot valkyrie();
Robot talos();
std::vector<Robot> all_robots();

/// The robot as URDF, and a study of its motion. @param solver entries of the study's block
/// `solver`.
GeneratedCase robot_case(const Robot& robot, const std::string& solver);

}  // namespace codesign
