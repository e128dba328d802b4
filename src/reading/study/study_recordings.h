// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/identification.h"
#include "description/robot.h"
#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads a list of recordings, `identify.data` or `identify.holdout`; at least one. @throws InputError
std::vector<RecordingDescription> read_recording_list(const YamlValue& list, const RobotDescription& robot, const Study& study);

}  // namespace codesign
