// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/motor_sides.h"

#include <gtest/gtest.h>

#include "integration/mechanisms.h"

namespace codesign {
namespace {

RobotDescription elastic_arm() {
  const std::string actuator =
      "<limit effort='30' velocity='2'/><codesign:actuator gear_ratio='50' rotor_inertia='1e-4' "
      "stiffness='1000' backlash='0.01' coulomb='0.02'/>";
  return read_urdf({"t.urdf", robot(bar("upper") + bar("lower") +
                                    hinge("shoulder", "ground", "upper", "0 0 0.3", actuator) +
                                    hinge("elbow", "upper", "lower", "0 0 -1", actuator))});
}

TEST(MotorSides, AreJointsBesideTheirs) {
  const RobotDescription both = with_motor_sides(elastic_arm(), {});
  ASSERT_EQ(both.joints.size(), 4u);
  ASSERT_EQ(both.links.size(), 5u);
  const JointDescription &elbow = both.joints[1], &motor = both.joints[3];
  EXPECT_EQ(elbow.motor, 3);
  EXPECT_TRUE(elbow.has_elastic_gear());
  EXPECT_EQ(motor.name, "elbow/motor");
  EXPECT_EQ(motor.parent, elbow.parent);
  EXPECT_EQ(motor.origin.xyz[2].nominal(), -1.0);
  EXPECT_TRUE(motor.is_motor);
  EXPECT_FALSE(motor.has_elastic_gear());
  EXPECT_EQ(motor.limit->effort.nominal(), 30.0);
  EXPECT_EQ(motor.actuator->gear->coulomb.nominal(), 0.02);
  EXPECT_FALSE(both.links[4].inertial);
}

// By the model and not by the name, which a joint of the file may have, too.
TEST(MotorSides, HaveTheJointBesideWhichTheyStand) {
  RobotDescription both = with_motor_sides(elastic_arm(), {});
  EXPECT_EQ(joint_of_motor(both, "elbow/motor"), "elbow");
  EXPECT_EQ(joint_of_motor(both, "elbow"), "elbow");
  both.joints[0].name = "left/motor";
  EXPECT_EQ(joint_of_motor(both, "left/motor"), "left/motor");
}

TEST(MotorSides, AreTakenAwayAndAddedAgain) {
  const RobotDescription twice = with_motor_sides(with_motor_sides(elastic_arm(), {}), {});
  EXPECT_EQ(twice.joints.size(), 4u);
  const RobotDescription none = without_motor_sides(twice);
  EXPECT_EQ(none.joints.size(), 2u);
  EXPECT_EQ(none.links.size(), 3u);
  EXPECT_EQ(none.joints[1].motor, -1);
}

TEST(MotorSides, DoNotExistWhereTheMotionIsGiven) {
  MotionStudy study;
  study.motion.emplace_back().joint = "shoulder";
  const RobotDescription one = with_motor_sides(elastic_arm(), study);
  ASSERT_EQ(one.joints.size(), 3u);
  EXPECT_EQ(one.joints[2].name, "elbow/motor");
  MotionStudy postures;
  postures.postures = 3;
  EXPECT_EQ(with_motor_sides(elastic_arm(), postures).joints.size(), 2u);
  MotionStudy driven;
  driven.rigid_gears = true;
  EXPECT_EQ(with_motor_sides(elastic_arm(), driven).joints.size(), 2u);
}

}  // namespace
}  // namespace codesign
