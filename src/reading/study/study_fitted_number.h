// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/identification.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Reads a known number, or a map `{initial, lower, upper}`, which may be empty, of a number to be fitted. Missing keys leave their values
/// unchanged.
/// @param lower bound of a fitted number unless another one is given. @throws InputError
void read_fitted(const YamlValue& value, double lower, FittedNumber* number);

}  // namespace codesign
