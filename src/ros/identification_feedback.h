// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_IDENTIFICATION_FEEDBACK_H_
#define MECHANISM_CODESIGN_ROS_IDENTIFICATION_FEEDBACK_H_

#include <mechanism_codesign/IdentificationProgress.h>
#include <ros/time.h>

#include <functional>
#include <string>
#include <vector>

#include "identification/residual_fit.h"

namespace codesign {

/// Called by the worker's thread for each message of progress.
using IdentificationObserver = std::function<void(const mechanism_codesign::IdentificationProgress&)>;

/// Makes the messages of a running identification, and keeps those of its evaluations for the bag. Used by one thread.
class IdentificationFeedback {
 public:
  /// @param names of what is fitted. @param most_evaluations of the fit. @param observer may be empty.
  IdentificationFeedback(std::string job, std::vector<std::string> names, int most_evaluations, IdentificationObserver observer);

  /// A stage begins: `reading` or `recording`, in which no evaluation is told.
  void begin(const std::string& stage);
  void tell(const FitTrial& trial);
  /// The last message: nothing is left.
  void finish();

  /// Moves out the messages of evaluations of the fit, those of profiles left out.
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

#endif  // MECHANISM_CODESIGN_ROS_IDENTIFICATION_FEEDBACK_H_
