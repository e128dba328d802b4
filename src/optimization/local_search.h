// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// @throws InputError for an algorithm that cannot minimize the ensemble's measure within the
/// study's constraints, and for options out of range.
void check_search(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble);

/// Minimizes the ensemble's measure from `start` with the algorithm of `options`, within bounds and
/// parameter constraints.
/// @param study of the problem: parameters, bounds, constraints. @param start of rho.
/// @throws InputError as optimize().
OptimizationResult search_locally(const Study& study, const OptimizerOptions& options,
                                  const Eigen::VectorXd& start, const Ensemble& ensemble,
                                  const TrialObserver& observer, const std::atomic<bool>* cancel);

}  // namespace codesign
