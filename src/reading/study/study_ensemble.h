// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/named_file.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/study/study_runs.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `runs:`, `uncertain:`, `robust:`, `multistart:` and `engine:`. All other blocks of the study must have been read. `robust` is set
/// exactly if the study has runs or uncertain quantities. @param files as in read_study(). @throws InputError
EnsembleDescription read_ensemble(const YamlValue& study_value, const RobotDescription& robot, const RunReader& read_run,
                                  const FileLoader& files, const Study& study);

}  // namespace codesign
