// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_OPTIMIZATION_NODE_H_
#define MECHANISM_CODESIGN_ROS_OPTIMIZATION_NODE_H_

#include <actionlib/server/action_server.h>
#include <actionlib_msgs/GoalID.h>
#include <mechanism_codesign/Evaluate.h>
#include <mechanism_codesign/Optimize.h>
#include <mechanism_codesign/OptimizeAction.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <functional>
#include <optional>
#include <string>

#include "ros/job.h"
#include "ros/node_state.h"
#include "ros/worker.h"

namespace codesign {

/// The node `optimization`: services `optimize` and `evaluate`, action `optimize`. See doc/ros_api.md.
///
/// One worker stands behind the service and the action `optimize`, another behind `evaluate`; who comes while it works is answered `busy`.
/// Callbacks only hand over and wait, on a queue of their own, so that every door answers at any time. With bad input the node is up and
/// says so.
class OptimizationNode {
 public:
  OptimizationNode();
  ~OptimizationNode();

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

  /// What whoever asked for a job is told, all of it in the worker's thread.
  struct Client {
    std::function<void()> begin;
    ProgressObserver progress;
    std::function<void(const Result&)> end;
  };

  /// Starts the job, or fills `refusal` and returns false.
  bool start(const mechanism_codesign::OptimizeGoal& request, const Client& client, Result* refusal);
  Result run(const mechanism_codesign::OptimizeGoal& request, const ProgressObserver& observer, const std::atomic<bool>& cancel);
  /// Whether the lists of a request are of a length that can be meant; fills `refusal` if not.
  template <class Reply>
  bool has_size(const std::vector<std::string>& names, const std::vector<double>& values, const std::string& field, Reply* refusal) const;
  void tell_result(const Result& result);

  ros::NodeHandle node_, private_node_{"~"};
  NodeState state_;
  std::optional<Problem> problem_;  // empty: the input was bad
  std::string fault_;               // why
  std::string study_;
  JobOptions options_;
  ros::Publisher progress_, tuned_;
  // From here on the order matters: what is used by callbacks and workers must outlive them.
  ros::CallbackQueue queue_;
  ros::NodeHandle doors_;
  std::unique_ptr<ActionServer> action_;
  Worker optimizer_, evaluator_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer optimize_, evaluate_;
  ros::Subscriber cancel_all_;
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_OPTIMIZATION_NODE_H_
