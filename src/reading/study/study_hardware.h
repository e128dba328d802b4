// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads `hardware:`, doc/study.md: for controllers of the study, the namespaces of their gains on the robot. The controllers must have
/// been read. @throws InputError for an unknown controller, a controller without gains of control_toolbox, a bad or repeated namespace, or
/// an `i` gain without `i_clamp`.
void read_hardware(const YamlValue& root, const ParameterTable& table, Study* study);

}  // namespace codesign
