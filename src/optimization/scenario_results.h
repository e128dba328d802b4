// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"

namespace codesign {

/// Completes the result of a study with runs or uncertain parameters: names its scenarios, and validates its best point on fresh samples if
/// `robust.validate` asks for it. Does nothing for other studies, and for a result without a point.
/// @param ensemble of the search; its engine runs the validation. @param meter counts the runs of the validation.
void describe_scenarios(const Problem& problem, const Ensemble& ensemble, const std::atomic<bool>* cancel, ProgressMeter* meter,
                        OptimizationResult* result);

}  // namespace codesign
