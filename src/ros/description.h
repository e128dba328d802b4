// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_DESCRIPTION_H_
#define MECHANISM_CODESIGN_ROS_DESCRIPTION_H_

#include <ros/node_handle.h>

#include <string>

#include "problem/load_problem.h"

namespace codesign {

/// A warning if the parameter `robot_description`, from which others draw and place the mechanism, describes another one than `effective`,
/// the URDF of what is simulated. Nothing if the parameter is not set.
Warnings check_description(const ros::NodeHandle& node, const Problem& problem, const std::string& effective);

/// Whether `text` describes the mechanism: it is the effective URDF, or the model itself where no overlay and no value changes it.
bool describes(const std::string& text, const Problem& problem, const std::string& effective);

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_DESCRIPTION_H_
