// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/IdentificationProgress.h>
#include <ros/time.h>

#include <functional>
#include <string>
#include <vector>

#include "identification/residual_fit.h"

namespace codesign {

/// Called by the worker's thread for each message of progress.
using IdentificationObserver = std::function<void(const mechanism_codesign::IdentificationProgress&)>;

/// Makes the progress messages of a running identification, and keeps the messages of evaluations for the bag. Used by one thread.
class IdentificationFeedback {
 public:
  /// @param names of the fitted numbers. @param most_evaluations limit of the fit. @param observer may be empty.
  IdentificationFeedback(std::string job, std::vector<std::string> names, int most_evaluations, IdentificationObserver observer);

  /// Begins a stage without evaluations: `reading` or `recording`.
  void begin(const std::string& stage);
  void tell(const FitTrial& trial);
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
