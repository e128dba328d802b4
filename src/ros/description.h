// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// `description_differs` if the parameter `robot_description`, which robot_state_publisher and rviz use, describes a mechanism other than
/// `effective`, the URDF that is simulated. No warning if the parameter is not set.
Warnings check_description(const ros::NodeHandle& node, const Problem& problem, const std::string& effective);

/// Whether the URDF `text` describes the simulated mechanism: it equals `effective`, with or without sticks for links that have no visual,
/// or it is the model's own file and neither overlays nor parameter values change the model.
bool describes(const std::string& text, const Problem& problem, const std::string& effective);

}  // namespace codesign
