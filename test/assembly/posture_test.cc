// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/posture.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(Posture, PositionsOfOneBranchDifferByRounding) {
  const Eigen::VectorXd theta = Eigen::Vector2d(3.0, -1.0);
  EXPECT_TRUE(is_same_branch(theta, theta + Eigen::Vector2d(0.0, 3.9e-6)));
  EXPECT_FALSE(is_same_branch(theta, theta + Eigen::Vector2d(0.0, 4.1e-6)));
}

TEST(Posture, IsPlacedAtItsAnglesAndRates) {
  LoopsToClose c(triangle());
  Posture posture = c.at({0.4, -0.7});
  posture.rate << 2.0, 3.0;
  State<double> state;
  state.resize(c.compiled.system.layout());
  std::vector<LinkMotion<double>> links;
  place(c.loops, c.design, posture, &links, &state);
  // Centres of bars of 1 m that hang on hinges about y.
  EXPECT_NEAR(state.q[0], -0.5 * std::sin(0.4), 1e-15);
  EXPECT_NEAR(state.q[7], 1.2 - 0.5 * std::sin(-0.7), 1e-15);
  EXPECT_NEAR(state.v[7], -0.5 * std::cos(-0.7) * 3.0, 1e-15);
}

TEST(Posture, AMotorFollowsItsJoint) {
  LoopsToClose c(triangle());
  TreeLayout tree = c.loops.tree;
  tree.motors = {{1, 0}};
  Posture posture = c.at({0.4, -0.7});
  posture.rate << 2.0, 3.0;
  follow_gears(tree, &posture);
  EXPECT_EQ(posture.theta[1], 0.4);
  EXPECT_EQ(posture.rate[1], 2.0);
}

}  // namespace
}  // namespace codesign
