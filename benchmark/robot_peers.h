// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "benchmark/robots.h"

namespace codesign {

/// At how many instants, equally spaced up to the end of the motion, codes are compared. All let a
/// step end there.
constexpr int kInstants = 5;

/// The motion of a robot: all joint positions at the instants, one instant after the other.
struct RobotMotion {
  std::vector<double> positions;
  long steps = 0;
};

/// By the articulated-body algorithm and the pair of Dormand and Prince.
RobotMotion run_plain(const Robot& robot, double tolerance);

/// By Simbody's Runge-Kutta-Merson method. No value where the motion is stiff, or the program is
/// built without Simbody.
std::optional<RobotMotion> run_simbody_robot(const Robot& robot, double accuracy);

}  // namespace codesign
