// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/json.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// The output of `codesign optimize --json` and the content of result.json, except `setup_seconds`,
/// `warnings` and `error`; doc/results.md.
Json optimization_json(const Problem& problem, const OptimizationResult& result);

/// The same as text, with the outcome that add_outcome() adds.
std::string optimization_report(const Problem& problem, const OptimizationResult& result,
                                const Warnings& of_run);

/// Adds the results of an optimization for several runs, samples and starts: `scenarios`,
/// `failed_scenarios`, `worst_scenario`, `value_at_risk`, `validation`, `multistart`. Adds nothing
/// for a study with one run and one start.
void add_ensemble(const Problem& problem, const OptimizationResult& result, Json* object);

/// Columns and rows of starts.csv: number, objectives at start and end, status, termination,
/// evaluations, optimum (from 1; 0: none), then the tuned parameters at the start and at the end.
std::vector<std::string> start_columns(const Problem& problem);
std::vector<std::vector<std::string>> start_rows(const OptimizationResult& result);

/// Columns and rows of scenarios.csv: run, sample (from 1; 0: nominal), weight, objective before
/// and after, whether the scenario failed (1) before and after, the friction law if it is
/// uncertain, then the parameters that any scenario sets. A cell is empty if the scenario does not
/// set the parameter.
std::vector<std::string> scenario_columns(const OptimizationResult& result);
std::vector<std::vector<std::string>> scenario_rows(const OptimizationResult& result);

}  // namespace codesign
