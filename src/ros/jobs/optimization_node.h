// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Apply.h>
#include <mechanism_codesign/Evaluate.h>
#include <mechanism_codesign/Identify.h>
#include <mechanism_codesign/IdentifyAction.h>
#include <mechanism_codesign/Optimize.h>
#include <mechanism_codesign/OptimizeAction.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ros/common/door.h"
#include "ros/common/node_state.h"
#include "ros/jobs/job.h"

namespace codesign {

/// The node `optimization`: services `optimize`, `identify`, `evaluate`, `apply` and `~cancel`,
/// actions `optimize` and `identify`. See doc/ros_api.md.
///
/// Each service has a worker thread, which it shares with the action of its name; a request to a
/// busy worker is answered with `busy`. Callbacks only pass the job to a worker and wait for its
/// end. They have their own queue with several threads, so that the node answers at any time. With
/// bad input the node stays up and answers every request with `bad_input`.
class OptimizationNode {
 public:
  /// @param ranks the processes of the job, as in require_engine().
  explicit OptimizationNode(Dispatcher* ranks);
  ~OptimizationNode();

  /// Cancels all jobs and returns when their clients have the answers, a running `apply` with a
  /// rollback to the robot's previous values. Only possible while ROS is up. Requests that come
  /// later are refused.
  void finish();

 private:
  using OptimizeResult = mechanism_codesign::OptimizeResult;
  using IdentifyResult = mechanism_codesign::IdentifyResult;
  using ApplyResponse = mechanism_codesign::ApplyResponse;

  void load();
  void open_doors();
  /// Refuses a request without a problem, and lists of inadmissible lengths. @throws std::exception
  void check(const std::vector<std::string>& names, const std::vector<double>& values,
             const std::string& field) const;
  OptimizeResult optimize(const mechanism_codesign::OptimizeGoal& request,
                          const FeedbackObserver& observer, const std::atomic<bool>& cancel);
  IdentifyResult identify(const mechanism_codesign::IdentifyGoal& request,
                          const IdentificationObserver& observer, const std::atomic<bool>& cancel);
  ApplyResponse apply(const mechanism_codesign::ApplyRequest& request,
                      const std::atomic<bool>& cancel);
  /// The path of the job that a request of `apply` names; empty: the last job. @throws InputError
  std::string path_of(const std::string& result);
  bool on_cancel_request(std_srvs::Trigger::Request& request,
                         std_srvs::Trigger::Response& response);
  void tell_progress(const mechanism_codesign::OptimizationProgress& progress);
  void tell_result(const OptimizeResult& result);
  void tell_result(const IdentifyResult& result);

  ros::NodeHandle node_, private_node_{"~"};
  NodeState state_;
  std::optional<Problem> problem_;  ///< empty after bad input
  std::string fault_;               ///< message of the bad input
  std::string study_;               ///< text of the study
  std::string folder_;  ///< folder of the study file; empty for a study on the parameter server
  JobOptions options_;
  std::mutex mutex_;
  std::string last_bag_;  ///< of the last job that has ended; guarded by mutex_
  ros::Publisher optimization_progress_, identification_progress_, tuned_, identified_;
  // The order of the members from here on matters: members that callbacks and workers use must
  // outlive them.
  ros::CallbackQueue queue_;
  ros::NodeHandle doors_;
  std::unique_ptr<ActionDoor<mechanism_codesign::OptimizeAction, mechanism_codesign::Optimize>>
      optimization_;
  std::unique_ptr<ActionDoor<mechanism_codesign::IdentifyAction, mechanism_codesign::Identify>>
      identification_;
  std::unique_ptr<Door<mechanism_codesign::Evaluate>> evaluation_;
  std::unique_ptr<Door<mechanism_codesign::Apply>> application_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer cancel_;
  ros::Subscriber cancel_apply_;
};

}  // namespace codesign
