// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/linear_study.h"

#include <gtest/gtest.h>

#include "control/reference.h"

namespace codesign {
namespace {

/// A servo whose set-point is 2 + 3 sin(2 pi t), a force on a link along y, and one parameter.
Study example() {
  Study study;
  study.parameters.emplace_back();
  study.parameters[0].name = "gain";
  ControllerDescription servo;
  servo.name = "servo";
  servo.output = "hinge";
  servo.setpoint.kind = ReferenceDescription::Kind::kSine;
  servo.setpoint.sine.amplitude = Quantity(3.0);
  servo.setpoint.sine.offset = Quantity(2.0);
  servo.realization.quantization = 0.1;
  study.controllers.push_back(servo);
  LoadDescription load;
  load.link = "bar";
  load.force[1].of_time = ReferenceDescription(5.0);
  study.loads.push_back(load);
  return study;
}

TEST(LinearStudy, NamesItsInputs) {
  const LinearStudy study = with_inputs(example(), {7.0}, 0.0, false);
  EXPECT_EQ(study.inputs, (std::vector<std::string>{"servo/setpoint", "servo/setpoint_rate",
                                                    "servo/setpoint_acceleration",
                                                    "servo/disturbance", "loads[0]/force/y"}));
  EXPECT_EQ(study.first, 1U);
  EXPECT_EQ(study.parameters.size(), 6U);
  EXPECT_EQ(study.disturbances, std::vector<int>{3});
  EXPECT_EQ(study.study.controllers[0].realization.quantization, 0.0);
}

TEST(LinearStudy, FunctionsHaveTheirValuesAndRatesAtTheTime) {
  constexpr double kTurn = 6.283185307179586;
  for (const bool at_rest : {false, true}) {
    const LinearStudy study = with_inputs(example(), {7.0}, 0.25, at_rest);
    const ReferenceMotion<double> motion =
        Reference<double>(study.study.controllers[0].setpoint, study.parameters).at(0.25);
    EXPECT_NEAR(motion.value, 5.0, 1e-14);
    EXPECT_NEAR(motion.rate, 0.0, 1e-14);
    EXPECT_NEAR(motion.acceleration, at_rest ? 0.0 : -3.0 * kTurn * kTurn, 1e-12);
  }
  // The inputs are its value, rate and acceleration.
  LinearStudy study = with_inputs(example(), {7.0}, 0.25, true);
  study.parameters[1] += 0.5;
  study.parameters[2] += 0.25;
  study.parameters[3] += 0.125;
  const ReferenceMotion<double> moved =
      Reference<double>(study.study.controllers[0].setpoint, study.parameters).at(0.25);
  EXPECT_NEAR(moved.value, 5.5, 1e-14);
  EXPECT_NEAR(moved.rate, 0.25, 1e-14);
  EXPECT_NEAR(moved.acceleration, 0.125, 1e-14);
}

TEST(LinearStudy, ViscousFrictionStays) {
  RobotDescription robot;
  robot.joints.emplace_back();
  JointDescription& joint = robot.joints[0];
  joint.friction.emplace();
  joint.friction->model = FrictionModel::kLuGre;
  joint.friction->mu_static = joint.friction->mu_dynamic = Quantity(0.4);
  joint.friction->viscous = Quantity(0.2);
  joint.damping = Quantity(0.1);
  joint.dry_friction = Quantity(3.0);
  joint.actuator.emplace();
  joint.actuator->gear.emplace();
  joint.actuator->gear->efficiency = Quantity(0.8);
  joint.actuator->gear->coulomb = Quantity(0.01);
  joint.actuator->gear->viscous = Quantity(1e-4);
  const JointDescription left = without_friction(robot).joints[0];
  EXPECT_EQ(left.friction->mu_static.nominal(), 0.0);
  EXPECT_EQ(left.friction->viscous.nominal(), 0.2);
  EXPECT_FALSE(left.friction->model->bristle);
  EXPECT_EQ(left.damping.nominal(), 0.1);
  EXPECT_TRUE(left.dry_friction.is_zero());
  EXPECT_FALSE(left.actuator->gear->efficiency);
  EXPECT_TRUE(left.actuator->gear->coulomb.is_zero());
  EXPECT_EQ(left.actuator->gear->viscous.nominal(), 1e-4);
}

}  // namespace
}  // namespace codesign
