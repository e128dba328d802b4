// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "observation/energy.h"

#include <gtest/gtest.h>

#include <array>

#include "integration/energy_balance.h"

namespace codesign {
namespace {

TEST(Energy, PendulumConservesIt) {
  const Balance b =
      balance(pendulum(), motion_study(10.0, "{hinge: {position: 1.0}}", "hinge/velocity", kTight));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-8);
}

TEST(Energy, DoublePendulumConservesIt) {
  const Balance b = balance(
      double_pendulum(),
      motion_study(10.0, "{shoulder: {position: 1.5}, elbow: {position: -0.4, velocity: 1.0}}",
                   "elbow/velocity", kTight));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-8);
}

TEST(Energy, FourBarWithRedundantHingesConservesIt) {
  const Balance b = balance(four_bar(), motion_study(10.0, "{left_hinge: {position: 0.6}}",
                                                     "left_hinge/velocity", kTight));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-8);
}

TEST(Energy, FrictionTakesExactlyItsWork) {
  const Balance b =
      balance(double_pendulum(pin_friction()),
              motion_study(2.0, "{shoulder: {position: 1.5}}", "elbow/velocity", kFriction));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(b.friction_work, 0.1);
  EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-6 * b.friction_work);
}

TEST(Energy, FourBarWithFrictionTakesExactlyItsWork) {
  const Balance b =
      balance(four_bar(pin_friction()),
              motion_study(2.0, "{left_hinge: {position: 0.6}}", "left_hinge/velocity", kFriction));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(b.friction_work, 0.1);
  EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-6 * b.friction_work);
}

TEST(Energy, APuckThatSlidesAndTurnsLosesItsFrictionWork) {
  const Balance b = balance(puck(), motion_study(1.0, "{}", "puck/velocity/x", kFriction));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(b.friction_work, 0.5);
  EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-6 * b.friction_work);
}

TEST(Energy, ABallJointLosesItsFrictionWork) {
  const Balance b = balance(ball_pendulum(),
                            motion_study(2.0, "{ball_x: {position: 1.0}, ball_z: {velocity: 8.0}}",
                                         "ball_x/velocity", kFriction));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_GT(b.friction_work, 0.1);
  EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-6 * b.friction_work);
}

// Includes the energy that the spring of a bristle takes from the motion and returns.
TEST(Energy, FrictionWithStatesTakesExactlyItsWork) {
  for (const char* model : {"gonthier", "lugre"}) {
    const std::vector<std::array<std::string, 2>> cases = {
        {double_pendulum(pin_friction()),
         motion_study(1.0, "{shoulder: {position: 1.5}}", "elbow/velocity", kFriction)},
        {puck(), motion_study(0.5, "{}", "puck/velocity/x", kFriction)},
        {ball_pendulum(), motion_study(0.5, "{ball_x: {position: 1.0}, ball_z: {velocity: 8.0}}",
                                       "ball_x/velocity", kFriction)}};
    for (const auto& [urdf, study] : cases) {
      const Balance b = balance(with_friction_model(urdf, model), study);
      ASSERT_TRUE(b.status.ok()) << model << ": " << b.status.cause;
      EXPECT_GT(b.friction_work, 0.1) << model;
      EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-5 * b.friction_work) << model;
    }
  }
}

TEST(Energy, ASpringConservesIt) {
  const Balance b = balance(
      spring_pendulum(), motion_study(5.0, "{hinge: {position: 0.7}}", "hinge/velocity", kTight));
  ASSERT_TRUE(b.status.ok()) << b.status.cause;
  EXPECT_LT(b.largest_drift, 1e-8);
}

}  // namespace
}  // namespace codesign
