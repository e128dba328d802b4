// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/study.h"
#include "reading/yaml/yaml_reader.h"

namespace codesign {

/// Whether an item of `constraints:` is a bound on the peak of a signal, which read_watched() reads, and not on parameters.
bool bounds_a_peak(const YamlValue& item);

/// Reads the constraints among parameters in the list `constraints:`, each `left >= right`, `left <= right` or
/// `{expression: "${...}", between: [lower, upper]}`; a bound on both sides becomes two constraints. Study::parameters must have been read.
/// @throws InputError
void read_constraints(const YamlValue& study_value, Study* study);

}  // namespace codesign
