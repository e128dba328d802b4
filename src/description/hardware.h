// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "description/quantity.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// Where the robot keeps the gains of one controller of the study: an entry of `hardware:`. doc/study.md describes it and the parameters
/// that control_toolbox::Pid reads there.
struct HardwareGains {
  std::string controller;           ///< a `pid` or `pd_gravity` of the study
  std::string name_space;           ///< of ROS parameters, without a slash at either end: "arm_controller/gains/elbow"
  std::optional<Quantity> i_clamp;  ///< largest effort of the integral term [N m or N]; present if the controller has an `i` gain
  bool antiwindup = false;          ///< whether the integral of the error itself stays within i_clamp / i
  SourceLocation where;
};

}  // namespace codesign
