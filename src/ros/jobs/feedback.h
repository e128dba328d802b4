// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentificationProgress.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <ros/time.h>

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "identification/fit/residual_fit.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/progress_meter.h"
#include "ros/bags/job_bag.h"

namespace codesign {

/// Called for each trial point, and about once a second between them, by one thread at a time.
using FeedbackObserver = std::function<void(const mechanism_codesign::OptimizationProgress&)>;

/// The trial points of a job in bounded memory: beyond `capacity` points, only every second, then
/// every fourth, ... point is kept, and always the last one.
class TrialLog {
 public:
  /// @param capacity even, at least 2.
  explicit TrialLog(std::size_t capacity = 10000) : capacity_(capacity) {}

  void add(LoggedTrial trial);

  /// Moves out the kept points, in order. The log must not be used afterwards.
  std::vector<LoggedTrial> take();

 private:
  std::size_t capacity_, stride_ = 1, count_ = 0;
  std::vector<LoggedTrial> kept_;
  LoggedTrial last_;
};

/// Makes the progress messages of a running job: one for each trial point, and between trial points
/// messages that repeat the last trial point with new progress. Keeps the trial points for the bag.
/// Thread-safe: trial points and progress come from different threads.
class JobFeedback {
 public:
  /// @param job name of the job. @param parameters names of the tuned parameters. @param observer
  /// may be empty; called by one thread at a time.
  JobFeedback(std::string job, std::vector<std::string> parameters, FeedbackObserver observer);

  /// Sends a trial point. @param progress of ProgressMeter::now(). The caller reads it before this
  /// call, since the meter itself calls the function below. Workers that finish runs at the same
  /// time may call in another order than their runs were counted; a message never goes back to an
  /// earlier count of runs.
  void publish(const Trial& trial, const Progress& progress);
  void publish(const Progress& progress);
  /// Sends the last message, with no time left.
  void finish(Progress progress);

  /// Moves out the trial points.
  std::vector<LoggedTrial> take();

 private:
  const std::string job_;
  const std::vector<std::string> parameters_;
  const FeedbackObserver observer_;
  std::mutex mutex_;  // guards all members below
  TrialLog log_;
  Progress latest_;  ///< with the largest count of runs
  mechanism_codesign::OptimizationProgress last_;

  void send(const Progress& progress);
};

/// Called by the worker's thread for each message of progress.
using IdentificationObserver =
    std::function<void(const mechanism_codesign::IdentificationProgress&)>;

/// Makes the progress messages of a running identification, and keeps the messages of evaluations
/// for the bag. Used by one thread.
class IdentificationFeedback {
 public:
  /// @param names of the fitted numbers. @param most_evaluations limit of the fit. @param observer
  /// may be empty.
  IdentificationFeedback(std::string job, std::vector<std::string> names, int most_evaluations,
                         IdentificationObserver observer);

  /// Begins a stage without evaluations: `reading` or `recording`.
  void begin(const std::string& stage);
  void publish(const FitTrial& trial);
  /// Sends the last message, with no time left.
  void finish();

  /// Moves out the messages of evaluations of the fit, without evaluations for profiles.
  std::vector<mechanism_codesign::IdentificationProgress> take() { return std::move(kept_); }

 private:
  void set_stage(const std::string& stage);
  void send();

  const int most_evaluations_;
  const IdentificationObserver observer_;
  const ros::WallTime begin_;
  ros::WallTime stage_begin_;
  mechanism_codesign::IdentificationProgress last_;
  std::vector<mechanism_codesign::IdentificationProgress> kept_;
};

}  // namespace codesign
