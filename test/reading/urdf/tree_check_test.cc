// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(TreeCheck, TheRootIsFoundWhereverItStands) {
  EXPECT_EQ(read_urdf(robot_text(link_with("arm") + kGround +
                                 joint_with("j", "continuous", "ground", "arm")))
                .root,
            1);
}

TEST(TreeCheck, ASecondParentClosesALoop) {
  // b is the child of a, and also of a hinge on the ground, which comes first in the file.
  const SourceText text = robot_text(kGround + link_with("a") + link_with("b") + "\n" +
                                     joint_with("ring", "continuous", "b", "a") + "\n" +
                                     joint_with("ga", "continuous", "ground", "a") + "\n" +
                                     joint_with("ab", "continuous", "a", "b"));
  expect_warning(text, "second_parent",
                 {"test.urdf:3: <joint name=\"ring\">", "read as a loop", "(value: a)"});
  const RobotDescription robot = read_urdf(text);
  ASSERT_EQ(robot.joints.size(), 3U);
  EXPECT_EQ(robot.joints[0].name, "ga");
  EXPECT_EQ(robot.joints[2].name, "ring");
  EXPECT_TRUE(robot.joints[2].is_loop);
}

TEST(TreeCheck, NoLinks) { expect_error(robot_text(""), {"the robot has no links"}); }

TEST(TreeCheck, Mimics) {
  const auto second = [](const std::string& joint) {
    return link_with("tip") +
           joint_with("wrist", "continuous", "arm", "tip", "<mimic joint=\"" + joint + "\"/>");
  };
  const SourceText unknown = hinged_arm("", second("hing"));
  expect_warning(unknown, "mimic_ignored",
                 {"<joint name=\"wrist\"> <mimic>: unknown joint to mimic, did you mean \"hinge\"?",
                  "moves freely"});
  EXPECT_FALSE(read_urdf(unknown).joints[1].mimic);
  expect_warning(hinged_arm("", second("wrist")), "mimic_ignored", {"mimic each other in a ring"});
  const RobotDescription ring = read_urdf(hinged_arm("<mimic joint=\"wrist\"/>", second("hinge")));
  EXPECT_EQ(ring.warnings.size(), 1U);
  EXPECT_TRUE(ring.joints[1].mimic) << "without the first the second makes sense";
}

TEST(TreeCheck, FrictionOfOrdinaryJointsNeedsItsDimensions) {
  const char* friction = "<codesign:friction mu_static=\"0.4\" mu_dynamic=\"0.3\"/>";
  expect_error(hinged_arm(friction),
               {"<joint name=\"hinge\"> <codesign:friction>", "joint_length"});
  const std::string chain = kGround + link_with("massless", "") + link_with("arm");
  EXPECT_NO_THROW(
      read_urdf(robot_text(chain + joint_with("x", "continuous", "ground", "massless", friction) +
                           joint_with("y", "continuous", "massless", "arm", friction))))
      << "they will be one universal joint, whose needs are another's to check";
}

}  // namespace
}  // namespace codesign
