// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// The gains of the controllers that `hardware:` names, as ROS parameters for `rosparam load`: p, i, d, i_clamp and antiwindup, as
/// control_toolbox::Pid reads them, below the namespace of each controller. Effort = p e + i int e dt + d de/dt with e = setpoint -
/// measured, in the study and on the robot, in SI units. Numbers read back as the same doubles. Empty without `hardware:`.
/// @param parameters all named parameters.
std::string gains_yaml(const Problem& problem, const std::vector<double>& parameters);

}  // namespace codesign
