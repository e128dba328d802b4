// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/EvaluateRequest.h>
#include <mechanism_codesign/EvaluateResponse.h>
#include <mechanism_codesign/IdentifyGoal.h>
#include <mechanism_codesign/IdentifyResult.h>
#include <mechanism_codesign/OptimizationProgress.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>
#include <ros/time.h>

#include <atomic>
#include <functional>
#include <string>

#include "problem/load_problem.h"
#include "ros/common/replies.h"
#include "ros/common/run_node.h"
#include "ros/jobs/feedback.h"

// The computations of the optimization node, without its communication. No ROS master is needed,
// and no function throws.

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

/// Optimizes, records runs of the initial and of the tuned design, and writes the bag. A journal
/// beside the bag makes the job resumable; it stays until the job has ended by itself. Bad input,
/// numerical failures and a full disk are returned as code and message of the result.
/// @param study text of the study, for the bag. @param cancel once set, the optimization ends with
/// its best point so far.
OptimizationOutcome run_optimization(const Problem& problem, const std::string& study,
                                     const mechanism_codesign::OptimizeGoal& request,
                                     const JobOptions& options, const FeedbackObserver& observer,
                                     const std::atomic<bool>& cancel);

/// Computes objective, gradient and gradient check at one design. @param cancel once set, it ends
/// soon with `cancelled`.
/// @param ranks as JobOptions::ranks.
mechanism_codesign::EvaluateResponse run_evaluation(
    const Problem& problem, const mechanism_codesign::EvaluateRequest& request,
    const std::atomic<bool>& cancel, Dispatcher* ranks = nullptr);

/// The result of an identification, and the identified model.
struct IdentificationOutcome {
  mechanism_codesign::IdentifyResult result;
  std::string identified_urdf;  ///< empty if nothing was fitted
};

/// Reads the recordings of the study, fits, and writes report, identified model, residuals and bag
/// beside each other. Bad input, numerical failures and a full disk are returned as code and
/// message of the result; a file that cannot be written costs that file alone. No ROS master is
/// needed, and it does not throw.
/// @param folder base of relative paths of recordings; empty: only absolute paths are accepted.
/// @param cancel once set, the fit ends with its best point so far, whose files are written.
IdentificationOutcome run_identification(const Problem& problem, const std::string& folder,
                                         const mechanism_codesign::IdentifyGoal& request,
                                         const JobOptions& options,
                                         const IdentificationObserver& observer,
                                         const std::atomic<bool>& cancel);

/// Limits the time for recording the motion of a job after it was cancelled (half a second, so that
/// a cancel is answered within one) or the node is asked to end (8 s: roslaunch kills a node after
/// 15 s).
class Patience {
 public:
  explicit Patience(const std::atomic<bool>& cancel) : cancel_(cancel) {}

  bool operator()() {
    const ros::WallTime now = ros::WallTime::now();
    // The end of the node cancels the job, too; a bag that is whole is then worth more than a quick
    // answer.
    if (is_ending()) return is_over(true, 8.0, now, &shutdown_);
    return is_over(cancel_, 0.5, now, &cancelled_);
  }

 private:
  static bool is_over(bool has_left, double seconds, const ros::WallTime& now,
                      ros::WallTime* since) {
    if (!has_left) return false;
    if (since->isZero()) *since = now;
    return now - *since > ros::WallDuration(seconds);
  }

  const std::atomic<bool>& cancel_;
  /// times of the first calls that saw a shutdown and a cancel
  ros::WallTime shutdown_, cancelled_;
};

}  // namespace codesign
