// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "description/study.h"

namespace codesign {

/// The index in RobotDescription::joints of the tree joint that an entry of `initial_state` names; -1 for a loop or an unknown name.
int tree_joint(const RobotDescription& robot, const InitialJointState& initial);

/// The model with the rotations that the study's `initial_state` gives for floating joints as their JointDescription::start_rotation.
RobotDescription with_start_rotations(RobotDescription robot, const Study& study);

}  // namespace codesign
