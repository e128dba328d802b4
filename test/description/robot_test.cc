// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/robot.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(JointDescription, TheElementTellsLoopsFromJoints) {
  JointDescription joint;
  joint.name = "pin";
  EXPECT_EQ(joint.element(), "<joint name=\"pin\">");
  joint.is_loop = true;
  EXPECT_EQ(joint.element(), "<loop name=\"pin\">");
}

TEST(JointType, OneCoordinate) {
  for (const RowReference<JointLaw>& joint : standard_laws().joints) {
    const bool turn = joint->type == JointType::kRevolute || joint->type == JointType::kContinuous;
    EXPECT_EQ(is_turn(joint->type), turn) << static_cast<int>(joint->type);
    EXPECT_EQ(has_one_coordinate(joint->type), turn || joint->type == JointType::kPrismatic) << static_cast<int>(joint->type);
  }
}

TEST(LimitDescription, ZerosAreNoLimits) {
  LimitDescription limit;
  EXPECT_FALSE(limit.bounds_position() || limit.bounds_effort() || limit.bounds_velocity());
  limit.lower = -1.0;
  EXPECT_TRUE(limit.bounds_position());
  limit.effort = Quantity(0.0, std::make_shared<const Expression>("x", std::vector<std::string>{"x"}));
  EXPECT_TRUE(limit.bounds_effort()) << "an expression";
  EXPECT_FALSE(limit.bounds_velocity());
}

}  // namespace
}  // namespace codesign
