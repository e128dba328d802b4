// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "description/robot.h"
#include "math/arrays.h"

namespace codesign {

/// Whether a joint plays by a `<codesign:clearance>`, so that its parent is a link without mass
/// that read_clearances() added, with the name of the joint above it.
inline bool has_clearance(const RobotDescription& robot, const JointDescription& joint) {
  return std::any_of(robot.joints.begin(), robot.joints.end(), [&](const JointDescription& other) {
    return other.is_play && other.child == joint.parent && !joint.is_play &&
           robot.links[to_index(other.child)].name == other.name;
  });
}

}  // namespace codesign
