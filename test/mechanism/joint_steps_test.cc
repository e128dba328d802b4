// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/joint_steps.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

struct Step {
  bool turns;
  Vector3<double> axis;
};

std::vector<Step> steps_of(JointType type) {
  JointDescription joint;
  joint.type = type;
  joint.axis = {Quantity(0.0), Quantity(3.0), Quantity(4.0)};
  std::vector<Step> steps;
  visit_steps(joint, std::vector<double>(), [&](bool turns, const Vector3<double>& axis) { steps.push_back({turns, axis}); });
  return steps;
}

TEST(JointSteps, HingesAndSlidesHaveOneAlongTheUnitAxis) {
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kPrismatic}) {
    const std::vector<Step> steps = steps_of(type);
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_EQ(steps[0].turns, type != JointType::kPrismatic);
    EXPECT_LT((steps[0].axis - Vector3<double>(0.0, 0.6, 0.8)).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(JointSteps, APlanarJointSlidesInItsPlaneAndTurnsAboutTheNormal) {
  const std::vector<Step> steps = steps_of(JointType::kPlanar);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_FALSE(steps[0].turns || steps[1].turns);
  EXPECT_TRUE(steps[2].turns);
  EXPECT_LT((steps[0].axis.cross(steps[1].axis) - steps[2].axis).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(JointSteps, AFloatingJointHasSixAndOthersNone) {
  const std::vector<Step> steps = steps_of(JointType::kFloating);
  ASSERT_EQ(steps.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(steps[static_cast<std::size_t>(k)].turns, k >= 3);
    EXPECT_EQ(steps[static_cast<std::size_t>(k)].axis, Vector3<double>(Vector3<double>::Unit(k % 3)));
  }
  for (JointType type : {JointType::kFixed, JointType::kSpherical, JointType::kUniversal}) EXPECT_TRUE(steps_of(type).empty());
}

}  // namespace
}  // namespace codesign
