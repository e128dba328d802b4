// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/EvaluateRequest.h>
#include <mechanism_codesign/EvaluateResponse.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

#include <atomic>
#include <functional>
#include <string>

#include "jobs/trial_lines.h"
#include "mechanism_codesign/status.h"
#include "mechanism_codesign/version.h"
#include "problem/load_problem.h"

// The computations of the optimization node, without its communication. No ROS master is needed, and no function throws.

namespace codesign {

class Dispatcher;

struct JobOptions {
  std::string output_directory;  ///< folder for the bags
  double rate = 50.0;            ///< samples per second in the bag
  Dispatcher* ranks = nullptr;   ///< the processes of the job, as in require_engine()
};

struct OptimizationOutcome {
  mechanism_codesign::OptimizeResult result;
  std::string tuned_urdf;  ///< empty if the start could not be evaluated
};

/// Called for each trial point, and about once a second between them, by one thread at a time.
using FeedbackObserver = std::function<void(const mechanism_codesign::OptimizationProgress&)>;

/// Optimizes, records runs of the initial and of the tuned design, and writes the bag. A journal beside the bag makes the job resumable; it
/// stays until the job has ended by itself. Bad input, numerical failures and a full disk are
/// returned as code and message of the result.
/// @param study text of the study, for the bag. @param cancel once set, the optimization ends with its best point so far.
OptimizationOutcome run_optimization(const Problem& problem, const std::string& study, const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const FeedbackObserver& observer, const std::atomic<bool>& cancel);

/// Computes objective, gradient and gradient check at one design. @param cancel once set, it ends soon with `cancelled`.
/// @param ranks as JobOptions::ranks.
mechanism_codesign::EvaluateResponse run_evaluation(const Problem& problem, const mechanism_codesign::EvaluateRequest& request,
                                                    const std::atomic<bool>& cancel, Dispatcher* ranks = nullptr);

/// Sets success, code, message and version of a reply from a status.
template <class Reply>
void set_status(const Status& status, Reply* reply) {
  reply->version = version();
  reply->success = status.ok();
  reply->code = name_of(status.code);
  if (!status.ok()) reply->message = reason(status);
}

/// Sets a reply without success: code, message and version.
template <class Reply>
void refuse(const std::string& code, const std::string& message, Reply* reply) {
  reply->version = version();
  reply->success = false;
  reply->code = code;
  reply->message = message;
}

}  // namespace codesign
