// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace codesign {

/// From now on, `act` replaces the reaction of roscpp when the process is asked to end: by SIGINT,
/// SIGTERM or SIGHUP, by `rosnode kill`, or by the master because another node has taken the name.
/// SIGHUP stays ignored where it is ignored already, as under nohup. Call it once, after
/// ros::init() with ros::init_options::NoSigintHandler and before the first node handle or
/// ros::start().
/// @param act called in a signal handler or in a thread of ROS, at each request; may only do what a
/// signal handler may do.
void on_end_request(void (*act)());

class Dispatcher;

/// A node, with the action to take when it is asked to end.
struct RunningNode {
  std::shared_ptr<void> node;
  /// Called in a thread of its own before the shutdown, while ROS is still up and serves callbacks;
  /// empty: no action.
  std::function<void()> before_shutdown;
};

/// Whether the node of this process has been asked to end; ROS may still be up, see
/// RunningNode::before_shutdown.
bool is_ending();

/// Runs a ROS node until it is shut down: initializes ROS, makes the node, and serves callbacks.
/// SIGTERM, SIGHUP and `rosnode kill` end it in the same way as SIGINT, so that results are kept.
/// @param make called once ROS is initialized; the node lives until the shutdown.
/// @return the exit code of the process: 0, also after printing `help` for `--help`; 2 for an
/// unknown argument.
int run_node(int argc, char** argv, const std::string& name, const std::string& help,
             const std::function<RunningNode()>& make);

/// The nodes, for run_node(). Their headers, and the headers of ROS, stay out of the files with
/// main().
RunningNode make_simulation_node();
/// @param ranks the processes of the job, as in require_engine(); must outlive the node.
RunningNode make_optimization_node(Dispatcher* ranks);

}  // namespace codesign
