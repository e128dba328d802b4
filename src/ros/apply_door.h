// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mechanism_codesign/Apply.h>
#include <ros/node_handle.h>
#include <std_msgs/Empty.h>

#include <mutex>
#include <string>

#include "ros/node_state.h"
#include "ros/worker.h"

namespace codesign {

/// The service `apply` of the node `optimization`, with a worker of its own, and the topic `apply/cancel`. See doc/ros_api.md.
class ApplyDoor {
 public:
  /// @param doors with the callback queue of services. @param output_directory must outlive this, as must state.
  ApplyDoor(const ros::NodeHandle& doors, const std::string& output_directory, NodeState* state);

  /// Notes the bag of a job that has ended; requests that name no job use it. Thread-safe.
  void note_job(const std::string& bag);
  /// Rolls back the values that a running request has sent, waits for its end, and accepts no further requests.
  void finish() { worker_.finish(); }

 private:
  bool on_request(mechanism_codesign::Apply::Request& request, mechanism_codesign::Apply::Response& response);
  /// The path of the job that a request names. @throws InputError
  std::string path_of(const std::string& result);

  ros::NodeHandle doors_;
  const std::string& output_directory_;
  NodeState& state_;
  std::mutex mutex_;
  std::string last_bag_;
  Worker worker_;
  ros::ServiceServer service_;
  ros::Subscriber cancel_;
};

/// The path of a job that a request names: a bare name, or a path below `directory`. @throws InputError for a path outside of `directory`.
std::string path_in(const std::string& directory, const std::string& result);

}  // namespace codesign
