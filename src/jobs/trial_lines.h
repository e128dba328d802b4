// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "identification/fit/residual_fit.h"
#include "mechanism_codesign/optimization.h"
#include "mechanism_codesign/status.h"
#include "optimization/progress_meter.h"
#include "optimization/scaling.h"

namespace codesign {

/// ", about 12 s left", ", at most 5 min left"; empty if the time is not known or nothing is left.
std::string time_left(const std::optional<double>& seconds, bool is_bound);

/// "screening: 12 of 400 points, 288 runs, 31.2 runs/s, about 5 min left".
std::string progress_line(const Progress& progress);

/// One line of text for each trial point of an optimization, for logs.
class TrialLines {
 public:
  /// @param study must outlive this.
  explicit TrialLines(const Study& study) : scaling_(study) {}

  /// "trial 12: objective 0.0123, scaled gradient 0.02, step 0.03, best 0.0123, at most 12 s left",
  /// and, with several searches, the number of the search before it. `step` is the distance from
  /// the best point of this search so far, in the scaled variables of doc/theory.md (24); the first
  /// trial of a search has none. @param progress at this trial.
  std::string line(const Trial& trial, const Progress& progress);

 private:
  /// The best point of a search so far.
  struct Best {
    int iteration;
    Eigen::VectorXd rho;
  };

  Scaling scaling_;
  std::map<int, Best> best_;  ///< by the number of the search
};

/// One line of text for each evaluation of a fit, for logs.
class FitLines {
 public:
  /// @param most_evaluations limit of the fit.
  explicit FitLines(int most_evaluations) : most_evaluations_(most_evaluations) {}

  /// "evaluation 3: cost 12.1, root mean squares 0.1 0.2, step 0.03, at most 12 s left"; `step` is
  /// the largest change of a number since the best point so far, over its size. For evaluations of
  /// profiles: "profile 2 of 5" when a profile begins, else empty.
  std::string line(const FitTrial& trial);

 private:
  using Clock = std::chrono::steady_clock;

  const int most_evaluations_;
  const Clock::time_point begin_ = Clock::now();
  int profile_ = 0, iteration_ = 0;
  Eigen::VectorXd best_;
};

}  // namespace codesign
