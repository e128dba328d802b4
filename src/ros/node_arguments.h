// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_
#define MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_

#include <optional>
#include <string>

namespace codesign {

/// Initializes a ROS node. SIGTERM ends it in the same way as SIGINT, so that results are kept.
/// @return nullopt if the node is to run; else the exit code: 0 after printing `help` for `--help`, 2 for an unknown argument.
std::optional<int> start_node(int argc, char** argv, const std::string& name, const std::string& help);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_NODE_ARGUMENTS_H_
