// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `objective:`, which may be missing or empty. Study::controllers must have been read.
/// @param table of Study::parameters. @throws InputError
void read_objective(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table,
                    const TrajectoryLoader& loader, Study* study);

}  // namespace codesign
