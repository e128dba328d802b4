// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "equations/compiled.h"

namespace codesign {
namespace {

constexpr double kSoft = 1e-9;  // compliance of the parallelogram's redundant rows

double largest_gap(Compiled* c) {
  Eigen::VectorXd errors, rates;
  c->equations.constraint_errors(c->state, &errors, &rates);
  return std::max(errors.cwiseAbs().maxCoeff(), rates.cwiseAbs().maxCoeff());
}

TEST(AssemblyContinuation, TheStudysCoordinateStaysAndTheOthersClose) {
  Compiled c(four_bar(), let_go("{left_hinge: {position: 0.6, velocity: 2.0}}", "left_hinge/velocity"), kSoft);
  ASSERT_TRUE(c.start().ok());
  // Somewhere else on the way, with the coupler a little off.
  TreeCoordinates from{c.assembly.theta(), Eigen::VectorXd::Zero(3)};
  from.theta << 1.1, 1.12, -1.09;
  from.rate << 0.7, 0.6, -0.9;
  c.state.t = 0.4;
  ASSERT_TRUE(c.assembly.solve_from(from, {}, &c.equations, &c.state).ok());
  EXPECT_EQ(c.state.t, 0.4);
  EXPECT_NEAR(c.assembly.theta()[0], 1.1, 1e-15);
  EXPECT_NEAR(c.assembly.theta()[1], 1.1, 1e-11);
  EXPECT_NEAR(c.assembly.theta()[2], -1.1, 1e-11);
  EXPECT_LT(largest_gap(&c), 1e-11);
  TreeCoordinates found;
  ASSERT_EQ(tree_coordinates(c.system, c.assembly.tree(), c.state, c.assembly.theta(), &c.equations, &found), "");
  EXPECT_NEAR(found.rate[0], 0.7, 1e-12);
  EXPECT_NEAR(found.rate[2], -0.7, 1e-11);
  // The next start is the study's again.
  ASSERT_TRUE(c.start().ok());
  EXPECT_NEAR(c.assembly.theta()[1], 0.6, 1e-12);
}

TEST(AssemblyContinuation, PositionsThatFitTheStartAloneAreReleased) {
  Compiled c(four_bar(),
             let_go("{left_hinge: {position: 0.6}, right_hinge: {position: 0.6}, left_pin: {position: -0.6}}", "left_hinge/velocity"),
             kSoft);
  ASSERT_TRUE(c.start().ok());
  TreeCoordinates from{c.assembly.theta(), Eigen::VectorXd::Zero(3)};
  from.theta << 0.7, 0.72, -0.71;
  ASSERT_TRUE(c.assembly.solve_from(from, {}, &c.equations, &c.state).ok());
  EXPECT_LT(largest_gap(&c), 1e-11);
}

}  // namespace
}  // namespace codesign
