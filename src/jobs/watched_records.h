// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/json_type.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Adds the list `signals`: of each signal with a constraint or a peak its bounds, its range before and after, in which run and sample, and
/// the violation. Nothing without one.
void add_watched(const OptimizationResult& result, Json* object);

/// One sentence per such signal, for people.
std::vector<std::string> watched_sentences(const OptimizationResult& result);

}  // namespace codesign
