// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/named_file.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads the map `uncertain:`.
/// @param study with its parameters. @param runs of the study; parameters that they set cannot be uncertain. @param files reads the file
/// that `from` names; empty: such a study is refused.
/// @throws InputError
std::vector<UncertainQuantity> read_uncertain(const YamlValue& uncertain, const RobotDescription& robot, const Study& study,
                                              const std::vector<RunDescription>& runs, const FileLoader& files);

}  // namespace codesign
