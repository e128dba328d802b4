// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads all of a study except the blocks of EnsembleDescription.
using RunReader = std::function<Study(const YamlValue& study_value)>;

/// Reads the map `runs:`. The changes of a run are merged into the study's own tree, and the whole is read by `read_run`.
/// @param study as read without changes. @throws InputError
std::vector<RunDescription> read_runs(const YamlValue& study_value, const Study& study, const RunReader& read_run);

}  // namespace codesign
