// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Warnings about a finished search: `max_evaluations_reached`, `not_stationary`, `parameter_on_bound`, `parameter_without_influence`,
/// `flat_direction`.
Warnings search_warnings(const Study& study, const OptimizerOptions& options, const OptimizationResult& result);

/// How the search ended, for people: "stationary to 3e-06", "stopped early: the slope is 0.4 of the start's"; empty without a point.
std::string stop_sentence(const OptimizationResult& result);

}  // namespace codesign
