// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Whether the best point was evaluated with its gradient; false if the search was cancelled before
/// the first trial or the start failed.
bool is_evaluated(const Problem& problem, const OptimizationResult& result);

/// Whether the objective at the best point is known; while screening, it is known without its
/// gradient.
bool has_objective(const Problem& problem, const OptimizationResult& result);

/// Whether there is a design to report. A cancelled optimization has one, which may be its start.
bool has_design(const Problem& problem, const OptimizationResult& result);

/// The index in `result.ensemble.scenarios` of the scenario with the largest psi at the best point,
/// among the scenarios that could be integrated; -1: there is none.
int worst_scenario(const OptimizationResult& result);

/// A sentence per signal with a constraint or a peak: its range before and after, and its
/// violation.
std::vector<std::string> watched_sentences(const OptimizationResult& result);

/// Sentences about runs, samples and starts; empty for a study with one run and one start.
std::vector<std::string> ensemble_sentences(const Problem& problem,
                                            const OptimizationResult& result);

/// report() without the warnings, of a result with has_design().
std::string outcome_text(const Problem& problem, const OptimizationResult& result);

}  // namespace codesign
