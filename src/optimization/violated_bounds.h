// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_VIOLATED_BOUNDS_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_VIOLATED_BOUNDS_H_

#include <string>
#include <vector>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Largest violation of a bound on a signal at which the bound still counts as met, in the unit of the signal.
constexpr double kMostViolation = 1e-8;

/// Whether the best point of a search meets all constraints, on parameters and on signals.
bool meets_constraints(const OptimizationResult& result);

/// A sentence that lists the violated bounds of signals, for the status.
std::string describe_violated(const std::vector<WatchedResult>& watched);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_VIOLATED_BOUNDS_H_
