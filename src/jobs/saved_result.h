// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "problem/load_problem.h"

namespace codesign {

/// The design in a result.json, best.json or identification.json: every entry of its `parameters`, to the last bit.
/// @throws InputError naming file and line if it is not JSON, has a number beyond the range of double, or no object `parameters` of
/// numbers.
ParameterSettings read_result(const SourceText& json);
/// The same, with the name of the file.
inline SavedDesign read_design(const SourceText& json) { return {json.name, read_result(json)}; }

}  // namespace codesign
