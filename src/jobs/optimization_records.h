// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "jobs/json.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/warning.h"
#include "problem/load_problem.h"

namespace codesign {

/// Whether the best point was evaluated with its gradient; false if the search was cancelled before
/// the first trial or the start failed.
bool is_evaluated(const Problem& problem, const OptimizationResult& result);

/// Whether the objective at the best point is known; while screening, it is known without its
/// gradient.
bool has_objective(const Problem& problem, const OptimizationResult& result);

/// Whether there is a design to report. A cancelled optimization has one, which may be its start.
bool has_design(const Problem& problem, const OptimizationResult& result);

/// The output of `codesign optimize --json` and the content of result.json, except `setup_seconds`,
/// `warnings` and `error`; doc/results.md.
Json optimization_json(const Problem& problem, const OptimizationResult& result);

/// The same as text, with the outcome that add_outcome() adds.
std::string optimization_report(const Problem& problem, const OptimizationResult& result,
                                const Warnings& of_run);

/// The index in `result.scenarios` of the scenario with the largest psi at the best point, among
/// the scenarios that could be integrated; -1: there is none.
int worst_scenario(const OptimizationResult& result);

/// Adds the results of an optimization for several runs, samples and starts: `scenarios`,
/// `failed_scenarios`, `worst_scenario`, `value_at_risk`, `validation`, `multistart`. Adds nothing
/// for a study with one run and one start.
void add_ensemble(const Problem& problem, const OptimizationResult& result, Json* object);

/// The same as sentences for people, one per line; empty for a study with one run and one start.
std::vector<std::string> ensemble_sentences(const Problem& problem,
                                            const OptimizationResult& result);

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
