// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `path:`, `final:` and `objective.peak:`, each a list that may be missing. Study::controllers and Study::duration must have been
/// read. @param table of Study::parameters. @throws InputError
void read_watched(const YamlValue& study_value, const RobotDescription& robot, const ParameterTable& table, const TrajectoryLoader& loader,
                  Study* study);

/// Checks that a study with watched signals does not select the adjoint, which cannot compute their derivatives. @throws InputError if it
/// does.
void refuse_adjoint_of_watched(const YamlValue& study_value, const Study& study);

}  // namespace codesign
