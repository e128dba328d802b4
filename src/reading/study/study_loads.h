// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `loads:`, the constant efforts and wrenches. @param table of Study::parameters. @throws InputError
void read_loads(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table, Study* study);

}  // namespace codesign
