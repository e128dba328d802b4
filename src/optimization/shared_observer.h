// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <tuple>
#include <utility>

#include "mechanism_codesign/optimization.h"

namespace codesign {

/// Passes the trials of searches in several threads to one observer: one trial at a time, numbered consecutively over all searches, with
/// the best objective of all searches.
class SharedObserver {
 public:
  explicit SharedObserver(const TrialObserver& observer) : observer_(observer) {}

  /// The observer of one search. @param start number of the search from 1.
  TrialObserver of(int start) {
    return [this, start](const Trial& trial) { return tell(trial, start); };
  }
  /// Whether the observer has ended the job; all searches then end at their next trial.
  bool is_stopped() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return stopped_;
  }

 private:
  bool tell(Trial trial, int start) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stopped_) return false;
    trial.start = start;
    trial.evaluation = ++evaluations_;
    const std::pair<double, double> rank{trial.best_violation, trial.best_objective};
    if (trial.status.ok() && (!has_best_ || rank < best_)) {
      if (has_best_) ++iterations_;
      has_best_ = true;
      best_ = rank;
    }
    trial.iteration = iterations_;
    std::tie(trial.best_violation, trial.best_objective) = best_;
    stopped_ = observer_ && !observer_(trial);
    return !stopped_;
  }

  const TrialObserver& observer_;
  std::mutex mutex_;
  int evaluations_ = 0, iterations_ = 0;
  std::pair<double, double> best_;  ///< violation of the constraints and objective of the best point
  bool has_best_ = false, stopped_ = false;
};

}  // namespace codesign
