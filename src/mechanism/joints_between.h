// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "description/robot.h"

namespace codesign {

/// The links from `link`, included, up to the root.
/// @param link_parent_joint per link: the tree joint above it, -1 for the root.
std::vector<int> links_above(const RobotDescription& robot, const std::vector<int>& link_parent_joint, int link);

/// The tree joints that are not fixed on the path between two links, which passes through their nearest common ancestor.
std::vector<int> joints_between(const RobotDescription& robot, const std::vector<int>& link_parent_joint, int predecessor, int successor);

}  // namespace codesign
