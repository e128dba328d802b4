// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"
#include "ros/job.h"
#include "ros/progress_log.h"

namespace codesign {

/// Makes the progress messages of a running job: one for each trial point, and between trial points messages that repeat the last trial
/// point with new progress. Keeps the messages of trial points for the bag. Thread-safe: trial points and progress come from different
/// threads.
class JobFeedback {
 public:
  /// @param job name of the job. @param parameters names of the tuned parameters. @param observer may be empty; called by one thread at a
  /// time.
  JobFeedback(std::string job, std::vector<std::string> parameters, FeedbackObserver observer);

  /// Sends a trial point. @param progress of ProgressMeter::now(). The caller reads it before this call, since the meter itself calls the
  /// function below. Workers that finish runs at the same time may call in another order than their runs were counted; a message never
  /// goes back to an earlier count of runs.
  void tell(const Trial& trial, const Progress& progress);
  void tell(const Progress& progress);
  /// Sends the last message, with no time left.
  void finish(Progress progress);

  /// Moves out the messages of trial points.
  std::vector<mechanism_codesign::OptimizationProgress> take();

 private:
  const std::string job_;
  const std::vector<std::string> parameters_;
  const FeedbackObserver observer_;
  std::mutex mutex_;  // guards all members below
  ProgressLog log_;
  Progress latest_;  ///< with the largest count of runs
  mechanism_codesign::OptimizationProgress last_;

  void set_progress(const Progress& progress);
};

}  // namespace codesign
