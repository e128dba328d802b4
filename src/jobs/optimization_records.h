// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "jobs/json_type.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// Whether the best point was evaluated with its gradient; false if the search was cancelled before the first trial or the start failed.
bool is_evaluated(const Problem& problem, const OptimizationResult& result);

/// Whether the objective at the best point is known; while screening, it is known without its gradient.
bool has_objective(const Problem& problem, const OptimizationResult& result);

/// Whether there is a design to report. A cancelled optimization has one, which may be its start.
bool has_design(const Problem& problem, const OptimizationResult& result);

/// The output of `codesign optimize --json` and the content of result.json, except `setup_seconds`, `warnings` and `error`; doc/results.md.
Json optimization_json(const Problem& problem, const OptimizationResult& result);

/// The same as text, with the outcome that add_outcome() adds.
std::string optimization_report(const Problem& problem, const OptimizationResult& result, const Warnings& of_run);

}  // namespace codesign
