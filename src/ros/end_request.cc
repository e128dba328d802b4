// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/end_request.h"

#include <ros/console.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <csignal>
#include <string>

namespace codesign {
namespace {

/// A global variable, since a signal handler has no argument for it.
std::atomic<void (*)()> end_act{nullptr};

extern "C" void on_end_signal(int) { end_act.load()(); }

/// @param words the caller's name and the reason, such as that another node has taken the name.
void on_shutdown_call(XmlRpc::XmlRpcValue& words, XmlRpc::XmlRpcValue& result) {
  if (words.getType() == XmlRpc::XmlRpcValue::TypeArray && words.size() > 1 && words[1].getType() == XmlRpc::XmlRpcValue::TypeString)
    ROS_WARN_STREAM("asked to shut down: " << static_cast<std::string&>(words[1]));
  end_act.load()();
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

void on_end_request(void (*act)()) {
  end_act = act;
  std::signal(SIGINT, on_end_signal);
  std::signal(SIGTERM, on_end_signal);
  if (std::signal(SIGHUP, on_end_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  // Binds the name before ros::start(), since the first function that is bound to a name keeps it.
  ros::XMLRPCManager::instance()->bind("shutdown", on_shutdown_call);
}

}  // namespace codesign
