// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/robot.h"

namespace codesign {

/// The default values of the model's parameters, in the order of RobotDescription::parameters.
inline std::vector<double> default_values(const RobotDescription& robot) {
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  return values;
}

}  // namespace codesign
