// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/run_node.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>
#include <thread>

namespace codesign {
namespace {

/// A global variable, since a signal handler has no argument for it.
std::atomic<void (*)()> end_act{nullptr};

extern "C" void on_end_signal(int) { end_act.load()(); }

/// @param words the caller's name and the reason, such as that another node has taken the name.
void on_shutdown_call(XmlRpc::XmlRpcValue& words, XmlRpc::XmlRpcValue& result) {
  if (words.getType() == XmlRpc::XmlRpcValue::TypeArray && words.size() > 1 &&
      words[1].getType() == XmlRpc::XmlRpcValue::TypeString)
    ROS_WARN_STREAM("asked to shut down: " << static_cast<std::string&>(words[1]));
  end_act.load()();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

/// must_end: a request to end the node has come. has_last_act: the node must act before ROS is shut
/// down.
std::atomic<bool> must_end{false}, has_last_act{false};

void end_node() {
  must_end = true;
  if (!has_last_act) ros::requestShutdown();
}

/// Serves callbacks until RunningNode::before_shutdown has returned, since nothing can be sent
/// after the shutdown of ROS.
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

void on_end_request(void (*act)()) {
  end_act = act;
  std::signal(SIGINT, on_end_signal);
  std::signal(SIGTERM, on_end_signal);
  // A file that becomes larger than the limit (ulimit -f) is an error of the write, as a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  if (std::signal(SIGHUP, on_end_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  // Binds the name before ros::start(), since the first function that is bound to a name keeps it.
  ros::XMLRPCManager::instance()->bind("shutdown", on_shutdown_call);
}

bool is_ending() { return must_end || ros::isShuttingDown(); }

int run_node(int argc, char** argv, const std::string& name, const std::string& help,
             const std::function<RunningNode()>& make) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word != "--help" && word != "-h") continue;
    std::cout << help;
    return 0;
  }
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  if (argc > 1) {
    std::cerr << name << ": unexpected argument \"" << argv[1]
              << "\"; parameters are given as _name:=value\n\n"
              << help;
    return 2;
  }
  on_end_request(end_node);
  const RunningNode node = make();
  serve_callbacks(node);
  return 0;
}

}  // namespace codesign
