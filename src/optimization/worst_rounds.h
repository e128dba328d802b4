// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Keeps the promise of a search for the worst case within the intervals of what is uncertain: as
/// long as the worst point of the best design exceeds the worst of its samples, this point becomes
/// a sample, and the search goes on from the best design; doc/theory.md (24b). At most
/// kMostWorstRounds times, then the warning `worst_between_samples` tells what is left. Does
/// nothing for other measures, and for searches without a point.
/// @param ensemble of the search; gets the samples. @param result of the search; that of the last
/// one, its start evaluated with all samples. @param study of the search.
void add_worst_points(const Problem& problem, const Study& study, const OptimizerOptions& options,
                      const TrialObserver& observer, const std::atomic<bool>* cancel,
                      Ensemble* ensemble, OptimizationResult* result);

constexpr int kMostWorstRounds = 4;

}  // namespace codesign
