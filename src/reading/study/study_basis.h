// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "description/study.h"
#include "reading/parameter_table.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Appends the parameters that basis controllers declare by `coefficients: {count, initial, lower, upper, tune}` to Study::parameters. For
/// a controller `push` they are push_c0, push_c1, ... @throws InputError
void declare_coefficients(const YamlValue& study_value, Study* study);

/// Reads the keys of one basis controller, after declare_coefficients(). @param table of Study::parameters.
/// @throws InputError
BasisDescription read_basis(const std::string& controller, const YamlValue& value, const ParameterTable& table, double study_duration);

}  // namespace codesign
