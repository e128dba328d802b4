// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimization/search_hooks.h"

namespace codesign {

/// As many combinations are all searched; of more, branch and bound leaves parts out.
constexpr double kMostListedCombinations = 50.0;

/// Minimizes a study whose tuned parameters are in part chosen from lists or whole numbers,
/// `choice` and `integer` of `parameters:`; theory (24n). The others are searched locally, with the
/// chosen ones fixed.
/// @throws InputError as optimize(), and if some parameters of a list are tuned and others are not.
OptimizationResult search_choices(const Problem& problem, const OptimizerOptions& options,
                                  const SearchHooks& hooks, const std::atomic<bool>* cancel);

/// Whether a study tunes parameters that are chosen from lists.
bool has_choices(const Study& study);

}  // namespace codesign
