// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/robot_gains.h"

#include <gtest/gtest.h>

#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

TEST(RobotGainsOfAStudy, AreThoseOfTheDesign) {
  const Problem problem = pendulum_on_hardware();
  Eigen::VectorXd rho = problem.start();
  rho[1] = 3.25;  // Kp
  const std::vector<RobotGains> all = robot_gains(problem, problem.parameters(rho));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name_space, "arm_controller/gains/hinge");
  EXPECT_EQ(all[0].controller, "hold");
  EXPECT_EQ(all[0].joint, "hinge");
  EXPECT_EQ((std::vector<double>{all[0].p, all[0].i, all[0].d, all[0].i_clamp}), (std::vector<double>{3.25, 0.25, 0.0, 2.0}));
  EXPECT_TRUE(all[0].antiwindup);
  EXPECT_FALSE(all[0].loses_weight);
}

TEST(RobotGainsOfAStudy, WithoutHardwareThereAreNone) { EXPECT_TRUE(robot_gains(pendulum(), pendulum().parameters()).empty()); }

}  // namespace
}  // namespace codesign
