// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_JOB_FEEDBACK_H_
#define MECHANISM_CODESIGN_ROS_JOB_FEEDBACK_H_

#include <mutex>
#include <string>
#include <vector>

#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"
#include "ros/job.h"
#include "ros/progress_log.h"

namespace codesign {

/// Makes the messages of a running job: one for each trial point, and between them those that repeat the last trial point and tell how far
/// the job is. Keeps those of trial points for the bag. Thread-safe: trial points and progress come from different threads.
class JobFeedback {
 public:
  /// @param job its name. @param parameters names of the tuned ones. @param observer may be empty; told by one thread at a time.
  JobFeedback(std::string job, std::vector<std::string> parameters, FeedbackObserver observer);

  /// A trial point. @param progress ProgressMeter::now(), which the caller asks before: the meter calls the function below. Workers that
  /// finish runs at the same time may call in another order than they were counted; messages never go back to an earlier count of runs.
  void tell(const Trial& trial, const Progress& progress);
  void tell(const Progress& progress);
  /// The last message: nothing is left.
  void finish(Progress progress);

  /// Moves out the messages of trial points.
  std::vector<mechanism_codesign::OptimizationProgress> take();

 private:
  const std::string job_;
  const std::vector<std::string> parameters_;
  const FeedbackObserver observer_;
  std::mutex mutex_;  // guards all that follows
  ProgressLog log_;
  Progress latest_;  ///< with the largest count of runs
  mechanism_codesign::OptimizationProgress last_;

  void set_progress(const Progress& progress);
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_JOB_FEEDBACK_H_
