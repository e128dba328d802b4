// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "engine/remembering_engine.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"

namespace codesign {

/// Optional connections of a job, besides its problem; each may be empty.
struct SearchHooks {
  TrialObserver trial;                       ///< as in optimize()
  ProgressObserver progress = nullptr;       ///< called about once a second, also while screening and validating
  std::shared_ptr<EvaluationMemory> memory;  ///< has the evaluations of an earlier process, and keeps the evaluations of this process
  Dispatcher* ranks = nullptr;               ///< the processes of the job, as in require_engine()
  ProgressMeter* meter = nullptr;            ///< meter of a caller that polls the progress; its observer replaces `progress`
};

/// The records for the engine of a job: its memory, and the count of runs for the meter, which must outlive the engine.
inline EngineRecords records_of(const SearchHooks& hooks, ProgressMeter* meter) {
  return {hooks.memory, [meter](bool computed) { meter->count_run(computed); }, hooks.ranks};
}

/// The observer of trials, extended so that each trial is counted before the observer is called.
inline TrialObserver counted_trials(const SearchHooks& hooks, ProgressMeter* meter) {
  return [observer = hooks.trial, meter](const Trial& trial) {
    meter->count_trial();
    return !observer || observer(trial);
  };
}

/// optimize() with hooks. With a memory the result is the same to the last bit, except for processor times.
OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options, const SearchHooks& hooks,
                              const std::atomic<bool>* cancel);

}  // namespace codesign
