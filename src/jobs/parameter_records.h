// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "jobs/json_type.h"
#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {

/// A list of all named parameters: `name`, `unit`, `tuned` (whether the study tunes it), `lower`, `upper` (null: none), `initial`,
/// `value`, and `bound`: lower or upper if a tuned value lies on it, else empty.
Json parameter_table(const Problem& problem, const OptimizationResult& result);

/// The gradient at the best point beside a reference by complex step (with `idas` by Ridders' differences): `method`, `gradient`,
/// `reference`, `largest_relative_difference`. If the check would probably take more than a few seconds, or if it fails, `skipped` has the
/// reason.
Json gradient_check_json(const Problem& problem, const OptimizationResult& result, const std::atomic<bool>* cancel);

}  // namespace codesign
