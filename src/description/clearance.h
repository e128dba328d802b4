// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

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

/// The name of a joint that lets `joint` play. @param way `x`, `y`, `z` or `turn`
inline std::string play_of(const std::string& joint, const std::string& way) {
  return joint + '_' + way;
}

/// The name of the contact that takes the place of a joint with clearance.
inline std::string clearance_contact(const std::string& joint) { return joint + "_clearance"; }
/// The same, of a joint with the name play_of().
inline std::string contact_of_play(const std::string& play) {
  return clearance_contact(play.substr(0, play.rfind('_')));
}

}  // namespace codesign
