// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

#include "engine/evaluation_engine.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"

namespace codesign {

/// Optional connections of a job, besides its problem; each may be empty.
struct SearchHooks {
  TrialObserver trial;  ///< as in optimize()
  /// called about once a second, also while screening and validating
  ProgressObserver progress = nullptr;
  /// has the evaluations of an earlier process, and keeps the evaluations of this process
  std::shared_ptr<EvaluationMemory> memory;
  Dispatcher* ranks = nullptr;  ///< the processes of the job, as in require_engine()
  /// meter of a caller that polls the progress; its observer replaces `progress`
  ProgressMeter* meter = nullptr;
};

/// The records for the engine of a job: its memory, and the count of runs for the meter, which must
/// outlive the engine.
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

/// optimize() with hooks. With a memory the result is the same to the last bit, except for
/// processor times.
OptimizationResult run_search(const Problem& problem, const OptimizerOptions& options,
                              const SearchHooks& hooks, const std::atomic<bool>* cancel);

/// optimize() of a compiled system: one search from the start values, without its scenarios
/// described.
OptimizationResult optimize(const std::shared_ptr<const CompiledSystem>& system,
                            const OptimizerOptions& options, const TrialObserver& observer = {},
                            const std::atomic<bool>* cancel = nullptr);

/// Passes the trials of searches in several threads to one observer: one trial at a time, numbered
/// consecutively over all searches, with the best objective of all searches.
class SharedObserver {
 public:
  explicit SharedObserver(const TrialObserver& observer) : observer_(observer) {}

  /// The observer of one search. @param start number of the search from 1. @param is_real false:
  /// its points are no designs, and none of them is the best.
  TrialObserver of(int start, bool is_real = true) {
    return [this, start, is_real](const Trial& trial) { return notify(trial, start, is_real); };
  }
  /// Whether the observer has ended the job; all searches then end at their next trial.
  bool is_stopped() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stopped_;
  }

 private:
  bool notify(Trial trial, int start, bool is_real) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) return false;
    trial.start = start;
    trial.evaluation = ++evaluations_;
    const std::pair<double, double> rank{trial.best_violation, trial.best_objective};
    if (is_real && trial.status.ok() && (!has_best_ || rank < best_)) {
      if (has_best_) ++iterations_;
      has_best_ = true;
      best_ = rank;
    }
    trial.iteration = iterations_;
    if (has_best_ || is_real) std::tie(trial.best_violation, trial.best_objective) = best_;
    stopped_ = observer_ && !observer_(trial);
    return !stopped_;
  }

  const TrialObserver& observer_;
  std::mutex mutex_;
  int evaluations_ = 0, iterations_ = 0;
  /// violation of the constraints and objective of the best point
  std::pair<double, double> best_;
  bool has_best_ = false, stopped_ = false;
};

}  // namespace codesign
