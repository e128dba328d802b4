// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/server/action_server.h>
#include <actionlib_msgs/GoalID.h>
#include <mechanism_codesign/Identify.h>
#include <mechanism_codesign/IdentifyAction.h>
#include <ros/node_handle.h>

#include <memory>
#include <optional>
#include <string>

#include "ros/identification_job.h"
#include "ros/node_state.h"
#include "ros/worker.h"

namespace codesign {

/// The study that a node has loaded.
struct LoadedStudy {
  std::optional<Problem> problem;  ///< empty after bad input
  std::string fault;               ///< message of the bad input
  std::string text;                ///< text of the study
  std::string folder;              ///< folder of the study file; empty for a study on the parameter server
  JobOptions options;
};

/// Service and action `identify` of the node `optimization`, with one worker for both. See doc/ros_api.md.
class IdentificationDoor {
 public:
  /// @param node for topics. @param doors with the callback queue of services and actions. @param loaded, state must outlive this.
  IdentificationDoor(const ros::NodeHandle& node, const ros::NodeHandle& doors, const LoadedStudy& loaded, NodeState* state);

  /// Accepts goals from now on.
  void open() { action_.start(); }
  /// Cancels the running job. @returns whether a job runs that had not been cancelled before.
  bool cancel() { return worker_.cancel(); }
  /// Cancels the running job, waits for its end, and accepts no further jobs.
  void finish() { worker_.finish(); }

 private:
  using ActionServer = actionlib::ActionServer<mechanism_codesign::IdentifyAction>;
  using GoalHandle = ActionServer::GoalHandle;
  using Result = mechanism_codesign::IdentifyResult;

  /// Callbacks to the client of a job, called in the worker's thread.
  struct Caller {
    std::function<void()> begin;
    IdentificationObserver progress;
    std::function<void(const Result&)> end;
  };

  bool on_request(mechanism_codesign::Identify::Request& request, mechanism_codesign::Identify::Response& response);
  void on_goal(GoalHandle goal);
  void on_cancel(const GoalHandle& goal);
  void on_cancel_all(const actionlib_msgs::GoalID& goal);
  /// Starts the job. If that is not possible (bad input, busy), fills `refusal` and returns false.
  bool start(const mechanism_codesign::IdentifyGoal& request, const Caller& caller, Result* refusal);
  Result run(const mechanism_codesign::IdentifyGoal& request, const IdentificationObserver& observer, const std::atomic<bool>& cancel);
  void tell_result(const Result& result);

  ros::NodeHandle node_, doors_;
  const LoadedStudy& loaded_;
  NodeState& state_;
  ros::Publisher progress_, identified_;
  ActionServer action_;
  Worker worker_;
  ros::ServiceServer service_;
  ros::Subscriber cancel_all_;
};

}  // namespace codesign
