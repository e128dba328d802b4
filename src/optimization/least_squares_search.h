// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_LEAST_SQUARES_SEARCH_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_LEAST_SQUARES_SEARCH_H_

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// search_locally() by Levenberg-Marquardt, doc/theory.md (24g): the mean over the scenarios, as a sum of squares, within bounds.
/// The study must have passed check_search().
OptimizationResult search_squares(const Study& study, const OptimizerOptions& options, const Eigen::VectorXd& start,
                                  const Ensemble& ensemble, const TrialObserver& observer, const std::atomic<bool>* cancel);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_LEAST_SQUARES_SEARCH_H_
