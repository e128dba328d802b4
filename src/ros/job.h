// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_JOB_H_
#define MECHANISM_CODESIGN_ROS_JOB_H_

#include <mechanism_codesign/EvaluateRequest.h>
#include <mechanism_codesign/EvaluateResponse.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

#include <atomic>
#include <functional>
#include <string>

#include "mechanism_codesign/status.h"
#include "problem/load_problem.h"

// What the optimization node computes, apart from how it is asked: none of it needs a master, none of it throws.

namespace codesign {

struct JobOptions {
  std::string output_directory;  ///< where bags go
  double rate = 50.0;            ///< samples per second in the bag
};

struct OptimizationOutcome {
  mechanism_codesign::OptimizeResult result;
  std::string tuned_urdf;  ///< empty if not even the start could be evaluated
};

/// Called for each trial point, in the thread that computes.
using ProgressObserver = std::function<void(const mechanism_codesign::OptimizationProgress&)>;

/// Optimizes, runs the initial and the tuned design, and writes the bag. Bad input, numerical failure and a full disk come back as code and
/// sentence.
OptimizationOutcome run_optimization(const Problem& problem, const std::string& study, const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const ProgressObserver& observer, const std::atomic<bool>& cancel);

/// Objective, gradient and gradient check at one design.
mechanism_codesign::EvaluateResponse run_evaluation(const Problem& problem, const mechanism_codesign::EvaluateRequest& request,
                                                    const std::atomic<bool>& cancel);

/// The status as a reply says it: code and sentence.
template <class Reply>
void set_status(const Status& status, Reply* reply) {
  reply->success = status.ok();
  reply->code = name_of(status.code);
  if (!status.ok()) reply->message = status.cause + " (at t = " + std::to_string(status.time) + " s)";
}

template <class Reply>
void refuse(const std::string& code, const std::string& message, Reply* reply) {
  reply->success = false;
  reply->code = code;
  reply->message = message;
}

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_JOB_H_
