// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_WARNINGS_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_WARNINGS_H_

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Warnings about a finished search: `max_evaluations_reached`, `parameter_on_bound`, `parameter_without_influence`.
Warnings search_warnings(const Study& study, const OptimizerOptions& options, const OptimizationResult& result);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_WARNINGS_H_
