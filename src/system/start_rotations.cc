// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/start_rotations.h"

namespace codesign {

int tree_joint(const RobotDescription& robot, const InitialJointState& initial) {
  for (std::size_t k = 0; k < robot.joints.size(); ++k)
    if (robot.joints[k].name == initial.joint && !robot.joints[k].is_loop) return static_cast<int>(k);
  return -1;
}

RobotDescription with_start_rotations(RobotDescription robot, const Study& study) {
  for (const InitialJointState& initial : study.initial_state) {
    const int joint = tree_joint(robot, initial);
    if (joint < 0 || !initial.rotation) continue;
    JointDescription& description = robot.joints[static_cast<std::size_t>(joint)];
    if (description.type == JointType::kFloating) description.start_rotation = *initial.rotation;
  }
  return robot;
}

}  // namespace codesign
