// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linear/linear_model.h"
#include "linear/linear_study.h"

namespace codesign {

/// The model that a linearization counts with, and what of its friction counts at given speeds.
struct CountedRobot {
  RobotDescription robot;
  bool has_sliding = false;  ///< whether friction along a joint counts at its given speed
  /// given speeds: joints and contacts whose friction counts with its slope at rest
  std::vector<std::string> at_rest{};
};

/// The model that a linearization about rest counts with, theory (67a): without friction, with all
/// of it, or at given speeds. Then a joint that moves with the speeds of the study's start has in
/// place of its friction a damping, the slope of its steady friction at that speed, with the normal
/// force and the gear's torque of the posture. The motor of an elastic gear moves with its joint.
/// @param study of the case. @param rest positions.
/// @throws InputError for given speeds, if no joint of the study starts with one.
CountedRobot counted_robot(const LinearCase& of, const LinearStudy& study,
                           const State<double>& rest);

}  // namespace codesign
