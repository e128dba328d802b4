// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_
#define MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_

#include <optional>
#include <string>

namespace codesign {

/// Starts a node as ros::init() does; SIGTERM ends it as SIGINT does, with its results.
/// @return the exit code, if there is nothing to start: 0 after printing `help` for `--help`, 2 for an argument that means nothing.
std::optional<int> start_node(int argc, char** argv, const std::string& name, const std::string& help);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_
