// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/excitation.h"
#include "description/robot.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads the map `excite:` of a study. Whether the joints determine the motion is not examined. @throws InputError
ExcitationDescription read_excitation(const YamlValue& excite, const RobotDescription& robot);

}  // namespace codesign
