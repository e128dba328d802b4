// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "description/study.h"
#include "ensemble/ensemble.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"
#include "optimization/search_hooks.h"
#include "problem/load_problem.h"
#include "text/cancel.h"

namespace codesign {

/// What all searches of one job share. Problem, options and hooks must outlive it.
struct SearchSet {
  /// @param points evaluations that the job has for side by side, as those of Ensemble.
  SearchSet(const Problem& of, const OptimizerOptions& by, const SearchHooks& hooks,
            const std::atomic<bool>* cancelled, int points = 1)
      : problem(of),
        study(study_of(of)),
        options(by),
        cancel(cancelled),
        own_meter(by.max_evaluations, hooks.progress),
        meter(hooks.meter ? *hooks.meter : own_meter),
        trial(counted_trials(hooks, &meter)),
        observer(trial),
        ensemble(of, points, records_of(hooks, &meter)) {}
  SearchSet(const SearchSet&) = delete;
  SearchSet& operator=(const SearchSet&) = delete;

  /// Whether the job is to end, by its caller or by the observer of trials.
  bool is_stopped() { return is_set(cancel) || observer.is_stopped(); }

  const Problem& problem;
  const Study& study;
  const OptimizerOptions& options;
  const std::atomic<bool>* const cancel;
  ProgressMeter own_meter;
  ProgressMeter& meter;       ///< the caller's, or own_meter
  const TrialObserver trial;  ///< the caller's; counts each trial
  SharedObserver observer;    ///< passes trials of several searches to it
  Ensemble ensemble;
};

/// The status of a job that was ended early.
inline Status cancelled_search() {
  return {StatusCode::kCancelled, 0.0, "cancelled; the best point so far is kept"};
}

}  // namespace codesign
