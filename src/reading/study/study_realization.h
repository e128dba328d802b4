// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// The optional keys of a controller of this kind: its `own` keys, then the keys about its program on a robot.
std::vector<std::string> with_realization_keys(ControllerKind kind, std::vector<std::string> own);

/// Reads them into ControllerDescription::realization; the gains must have been read. @throws InputError
void read_realization(const YamlValue& value, const ParameterTable& table, ControllerDescription* controller);

/// Checks that a study with sampled controllers does not select the adjoint, which cannot reverse their jumps. @throws InputError if it
/// does.
void refuse_adjoint_of_sampled(const YamlValue& study_value, const Study& study);

}  // namespace codesign
