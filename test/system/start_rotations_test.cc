// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/start_rotations.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(StartRotations, AreTakenOverByFloatingJointsOfTheTreeAlone) {
  RobotDescription robot;
  for (const auto& [name, type, is_loop] :
       {std::tuple{"base", JointType::kFloating, false}, {"hinge", JointType::kRevolute, false}, {"closure", JointType::kRevolute, true}}) {
    JointDescription& joint = robot.joints.emplace_back();
    joint.name = name;
    joint.type = type;
    joint.is_loop = is_loop;
  }
  Study study;
  for (const char* name : {"base", "hinge", "closure"}) {
    InitialJointState& initial = study.initial_state.emplace_back();
    initial.joint = name;
    initial.rotation = QuantityVector{0.1, 0.2, 0.3};
  }
  EXPECT_EQ(tree_joint(robot, study.initial_state[1]), 1);
  EXPECT_EQ(tree_joint(robot, study.initial_state[2]), -1);
  const RobotDescription turned = with_start_rotations(robot, study);
  EXPECT_EQ(turned.joints[0].start_rotation[2].nominal(), 0.3);
  EXPECT_EQ(turned.joints[1].start_rotation[2].nominal(), 0.0);
}

}  // namespace
}  // namespace codesign
