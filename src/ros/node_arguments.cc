// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/node_arguments.h"

#include <ros/init.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <thread>

#include "ros/end_request.h"

namespace codesign {
namespace {

/// must_end: a request to end the node has come. has_last_act: the node must act before ROS is shut down.
std::atomic<bool> must_end{false}, has_last_act{false};

void end_node() {
  must_end = true;
  if (!has_last_act) ros::requestShutdown();
}

/// Serves callbacks until RunningNode::before_shutdown has returned, since nothing can be sent after the shutdown of ROS.
void serve_callbacks(const RunningNode& node) {
  if (!node.before_shutdown) return ros::spin();
  has_last_act = true;
  std::thread ending([&node] {
    while (!must_end && ros::ok()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    node.before_shutdown();
    ros::requestShutdown();
  });
  ros::spin();
  ending.join();
}

}  // namespace

bool is_ending() { return must_end || ros::isShuttingDown(); }

int run_node(int argc, char** argv, const std::string& name, const std::string& help, const std::function<RunningNode()>& make) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word != "--help" && word != "-h") continue;
    std::cout << help;
    return 0;
  }
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  if (argc > 1) {
    std::cerr << name << ": unexpected argument \"" << argv[1] << "\"; parameters are given as _name:=value\n\n" << help;
    return 2;
  }
  on_end_request(end_node);
  const RunningNode node = make();
  serve_callbacks(node);
  return 0;
}

}  // namespace codesign
