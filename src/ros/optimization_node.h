// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/server/action_server.h>
#include <actionlib_msgs/GoalID.h>
#include <mechanism_codesign/Evaluate.h>
#include <mechanism_codesign/Optimize.h>
#include <mechanism_codesign/OptimizeAction.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>

#include "ros/apply_door.h"
#include "ros/identification_door.h"
#include "ros/job.h"
#include "ros/node_state.h"
#include "ros/worker.h"

namespace codesign {

/// The node `optimization`: services `optimize`, `identify`, `evaluate`, `apply` and `~cancel`, actions `optimize` and `identify`. See
/// doc/ros_api.md.
///
/// One worker thread serves the service and the action `optimize`, another one `identify`, a third `evaluate`; a request to a busy worker
/// is answered with `busy`. Callbacks only pass the job to a worker and wait for its end. They have their own queue with several threads,
/// so that the node answers at any time. With bad input the node stays up and answers every request with `bad_input`.
class OptimizationNode {
 public:
  /// @param ranks the processes of the job, as in require_engine().
  explicit OptimizationNode(Dispatcher* ranks);
  ~OptimizationNode();

  /// Cancels all jobs and returns when their clients have the answers, a running `apply` with a rollback to the robot's previous values.
  /// Only possible while ROS is up. Requests that come later are refused.
  void finish();

 private:
  using ActionServer = actionlib::ActionServer<mechanism_codesign::OptimizeAction>;
  using GoalHandle = ActionServer::GoalHandle;
  using Result = mechanism_codesign::OptimizeResult;

  void load();
  bool on_optimize(mechanism_codesign::Optimize::Request& request, mechanism_codesign::Optimize::Response& response);
  bool on_evaluate(mechanism_codesign::Evaluate::Request& request, mechanism_codesign::Evaluate::Response& response);
  void on_goal(GoalHandle goal);
  void on_cancel(const GoalHandle& goal);
  void on_cancel_all(const actionlib_msgs::GoalID& goal);
  bool on_cancel_request(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  /// Callbacks to the client of a job, called in the worker's thread.
  struct Client {
    std::function<void()> begin;
    FeedbackObserver progress;
    std::function<void(const Result&)> end;
  };

  /// Starts the job. If that is not possible (bad input, busy), fills `refusal` and returns false.
  bool start(const mechanism_codesign::OptimizeGoal& request, const Client& client, Result* refusal);
  Result run(const mechanism_codesign::OptimizeGoal& request, const FeedbackObserver& observer, const std::atomic<bool>& cancel);
  /// Whether the lists of a request have admissible lengths; fills `refusal` if not.
  template <class Reply>
  bool has_size(const std::vector<std::string>& names, const std::vector<double>& values, const std::string& field, Reply* refusal) const;
  void tell_progress(const mechanism_codesign::OptimizationProgress& progress);
  void tell_result(const Result& result);

  ros::NodeHandle node_, private_node_{"~"};
  NodeState state_;
  LoadedStudy loaded_;
  ros::Publisher progress_, tuned_;
  // The order of the members from here on matters: members that callbacks and workers use must outlive them.
  ros::CallbackQueue queue_;
  ros::NodeHandle doors_;
  std::unique_ptr<ActionServer> action_;
  std::unique_ptr<IdentificationDoor> identification_;
  std::unique_ptr<ApplyDoor> application_;
  Worker optimizer_, evaluator_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer optimize_, evaluate_, cancel_;
  ros::Subscriber cancel_all_;
};

}  // namespace codesign
