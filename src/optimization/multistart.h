// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "optimization/search_hooks.h"

namespace codesign {

/// Searches from several starts, `multistart:` of the study. Screening evaluates the objective at
/// points of the sampler within the bounds, the study's own start first; points that fail or
/// violate the parameter constraints are replaced by further ones. The best points start local
/// searches, and results nearer to each other than `cluster` (largest difference of scaled
/// parameters) count as one optimum. The result is the best search's, with sums over all; it does
/// not depend on the number of workers.
/// @throws InputError as optimize().
OptimizationResult search_from_many_starts(const Problem& problem, const OptimizerOptions& options,
                                           const SearchHooks& hooks,
                                           const std::atomic<bool>* cancel);

/// Sets StartResult::optimum and returns the optima, best first. @param scaled the result of each
/// search in scaled parameters.
/// @param distance largest difference of scaled parameters within an optimum.
std::vector<Optimum> cluster_optima(const std::vector<std::vector<double>>& scaled, double distance,
                                    std::vector<StartResult>* starts);

}  // namespace codesign
