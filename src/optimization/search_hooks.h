// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_
#define MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_

#include <memory>

#include "engine/remembering_engine.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"

namespace codesign {

/// What a job has besides its problem; each may be empty.
struct SearchHooks {
  TrialObserver trial;                       ///< as in optimize()
  ProgressObserver progress = nullptr;       ///< told about once a second, while screening and validating too
  std::shared_ptr<EvaluationMemory> memory;  ///< evaluations of an earlier process, and the place for those of this one
  Dispatcher* ranks = nullptr;               ///< the processes of the job, as in require_engine()
  ProgressMeter* meter = nullptr;            ///< of a caller who asks how far the job is; `progress` is not told then, but its observer
};

/// What the engine of a job records: its memory, and runs for the meter, which must outlive the engine.
inline EngineRecords records_of(const SearchHooks& hooks, ProgressMeter* meter) {
  return {hooks.memory, [meter](bool computed) { meter->count_run(computed); }, hooks.ranks};
}

/// The observer of trials, which are counted before it is told.
inline TrialObserver counted_trials(const SearchHooks& hooks, ProgressMeter* meter) {
  return [observer = hooks.trial, meter](const Trial& trial) {
    meter->count_trial();
    return !observer || observer(trial);
  };
}

/// optimize() with hooks. With a memory the result is the same bits, except for processor times.
OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
                              const std::atomic<bool>* cancel);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_OPTIMIZATION_SEARCH_HOOKS_H_
