// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "problem/load_problem.h"

namespace codesign {

/// The gains of one controller as control_toolbox::Pid takes them. Effort = p e + i int e dt + d
/// de/dt with e = setpoint - measured, in SI units.
struct RobotGains {
  std::string name_space;  ///< namespace of the gains on the robot, without a slash at either end
  std::string controller;  ///< name of the controller in the study
  std::string joint;       ///< the joint that the controller drives
  /// whether the controller also compensates gravity in the study, which these gains do not
  bool loses_weight = false;
  bool gives_voltage = false;  ///< the output is the voltage of the joint's motor, no effort
  double p = 0.0, i = 0.0, d = 0.0;
  /// bounds of the effort of the integral term [N m or N], lower <= 0 <= upper
  double i_clamp_min = 0.0, i_clamp_max = 0.0;
  bool antiwindup = false;  ///< whether the integral of the error itself stays within i_clamp / i
  /// what the controller of the study does, and control_toolbox::Pid with these gains does not
  std::vector<std::string> missing;
};

/// The gains of the controllers that `hardware:` names, in its order; empty without it.
/// @param parameters all named parameters.
std::vector<RobotGains> robot_gains(const Problem& problem, const std::vector<double>& parameters);

/// The gains of the controllers that `hardware:` names, as ROS parameters for `rosparam load`: p,
/// i, d, i_clamp, or i_clamp_max and i_clamp_min where they differ, and antiwindup, as
/// control_toolbox::Pid reads them, below the namespace of each controller; comments say what a
/// controller does besides. Effort = p e + i int e dt + d de/dt with e = setpoint - measured, in
/// the study and on the robot, in SI units. Numbers read back as the same doubles. Empty without
/// `hardware:`.
/// @param parameters all named parameters.
std::string gains_yaml(const Problem& problem, const std::vector<double>& parameters);

}  // namespace codesign
