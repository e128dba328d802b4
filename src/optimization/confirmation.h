// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <string>

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Compares the gradient at the best point of an ended search with differences of the objective
/// through other steps, doc/theory.md (22c). Where they refute it, the search is no success: the
/// termination becomes `stopped_early`, with the warning `gradient_disagrees`. Of an interrupted
/// check, the search is cancelled. Does nothing for searches that did not end by themselves within
/// their constraints, and for postures, which have no steps.
/// @param ensemble of the search.
void confirm_stop(const Study& study, const OptimizerOptions& options, const Ensemble& ensemble,
                  const std::atomic<bool>* cancel, OptimizationResult* result);

/// Appended to "stationary to 3e-06" where the differences did not confirm it, with the reason;
/// else empty.
std::string describe_confirmation(const OptimizationResult& result);

}  // namespace codesign
