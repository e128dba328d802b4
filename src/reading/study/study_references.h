// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/reference.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads a function of time: a quantity, or a map whose `type` is sine, waypoints or trajectory.
/// @param loader for trajectories; may be empty. @throws InputError
ReferenceDescription read_reference(const YamlValue& value, const ParameterTable& table, const TrajectoryLoader& loader);

}  // namespace codesign
