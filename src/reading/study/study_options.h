// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

// All throw InputError for unknown keys and values out of range.

/// Reads the map `limits:`.
LimitOptions read_limit_options(const YamlValue& limits);

/// Reads the map `solver:`.
SolverOptions read_solver_options(const YamlValue& solver);

/// Reads the map `optimizer:`.
OptimizerOptions read_optimizer_options(const YamlValue& optimizer);

}  // namespace codesign
