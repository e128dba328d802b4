// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_

#include <memory>

#include "engine/evaluation_memory.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {

/// What a job has besides its problem; each may be empty.
struct SearchHooks {
  TrialObserver trial;                       ///< as in optimize()
  std::shared_ptr<EvaluationMemory> memory;  ///< evaluations of an earlier process, and the place for those of this one
};

/// optimize() with hooks. With a memory the result is the same bits, except for processor times.
OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
                              const std::atomic<bool>* cancel);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_
