// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/identification.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads the map `identify:` of a study whose parameters have been read. The recordings themselves are not opened.
/// @param is_planned the study has a block `excite:`, so that there may be no data yet. @throws InputError
IdentificationDescription read_identification(const YamlValue& identify, const RobotDescription& robot, const Study& study,
                                              bool is_planned = false);

/// The duration of a study with `identify:` that has no `duration`: the duration of a segment, `identify.segment` or its default [s].
double segment_of(const YamlValue& identify);

}  // namespace codesign
