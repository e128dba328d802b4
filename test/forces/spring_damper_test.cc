// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/spring_damper.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

constexpr double kSpringStiffness = 1000.0, kSpringDamping = 50.0, kSpringFree = 0.1;

TEST(SpringDamper, ByHand) {
  // Length 0.5 m, 0.4 m above the free length; its rate is 0.6 * 0.1 - 0.8 * 0.2 = -0.1 m/s.
  const auto s = spring_damper<double>({0.3, 0.0, -0.4}, {0.1, 5.0, 0.2}, kSpringStiffness, kSpringDamping, kSpringFree);
  EXPECT_NEAR(s.length, 0.5, 1e-15);
  EXPECT_NEAR(s.tension, 400.0 - 5.0, 1e-11);
  EXPECT_NEAR((s.pull - 395.0 * Eigen::Vector3d(0.6, 0.0, -0.8)).norm(), 0.0, 1e-11);
  EXPECT_NEAR(spring_energy<double>({0.3, 0.0, -0.4}, kSpringStiffness, kSpringFree), 0.5 * 1000.0 * 0.16, 1e-12);
}

TEST(SpringDamper, PointsThatMeetFeelNothing) {
  const auto s = spring_damper<double>(Eigen::Vector3d::Zero(), {0.1, 5.0, 0.2}, kSpringStiffness, kSpringDamping, kSpringFree);
  EXPECT_EQ(s.pull.norm(), 0.0);
  // Without a free length the spring is linear through zero: pull = k d.
  const Eigen::Vector3d d(1e-12, -3e-10, 2e-9);
  const auto zero_length = spring_damper<double>(d, Eigen::Vector3d::Zero(), kSpringStiffness, 0.0, 0.0);
  EXPECT_NEAR((zero_length.pull - kSpringStiffness * d).norm(), 0.0, 1e-18);
}

}  // namespace
}  // namespace codesign
