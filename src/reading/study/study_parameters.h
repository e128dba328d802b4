// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `parameters:` into Study::parameters (the model's, then the study's own) and Study::tuned (in the order written). Start and bounds
/// default to the model's; a parameter that the model does not have needs `initial`. @throws InputError
void read_parameters(const YamlValue& study_value, const RobotDescription& robot, Study* study);

/// Sets a parameter's bounds to `lower` and `upper` of a map, where given.
/// @throws InputError if lower is not below upper, or the parameter's value is not within them.
void read_bounds(const YamlValue& value, Parameter* parameter);

}  // namespace codesign
