// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/scaled_loops.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(ScaledLoops, RowsThatAreNotEnforcedAreZero) {
  LoopsToClose c(triangle(), "{}", without_row(0));
  const Posture posture = c.at({-0.5, 0.5});
  ScaledLoops all, enforced;
  all.evaluate(c.loops, c.design, posture.theta, LoopRows::kAll);
  enforced.evaluate(c.loops, c.design, posture.theta, LoopRows::kEnforced);
  EXPECT_EQ(Eigen::MatrixXd(all.unscaled), Eigen::MatrixXd(enforced.unscaled));
  EXPECT_GT(Eigen::MatrixXd(all.matrix).row(0).norm(), 0.1);
  EXPECT_EQ(Eigen::MatrixXd(enforced.matrix).row(0).norm(), 0.0);
  EXPECT_EQ(Eigen::MatrixXd(all.matrix).bottomRows(4),
            Eigen::MatrixXd(enforced.matrix).bottomRows(4));
}

TEST(LoopStep, IsTheChangeThatTakesTheErrorsAway) {
  LoopsToClose c(triangle());
  const Posture posture = c.at({-0.4, 0.6});
  const std::vector<int> both{0, 1}, one{1};
  LoopStep step;
  step.loops.evaluate(c.loops, c.design, posture.theta, LoopRows::kAll);
  const Eigen::MatrixXd J = step.loops.unscaled;
  const Eigen::MatrixXd errors = J * Eigen::Vector2d(0.3, -0.2);
  const Eigen::MatrixXd change =
      step.find(c.loops, c.design, {both, Posture::kRank, LoopRows::kAll}, posture.theta, errors);
  EXPECT_NEAR(change(0, 0), 0.3, 1e-14);
  EXPECT_NEAR(change(1, 0), -0.2, 1e-14);
  // One coordinate takes away what it can.
  const Eigen::MatrixXd alone = step.find(c.loops, c.design, {one, Posture::kRank, LoopRows::kAll},
                                          posture.theta, J.col(1) * 0.7);
  ASSERT_EQ(alone.rows(), 1);
  EXPECT_NEAR(alone(0, 0), 0.7, 1e-14);
}

}  // namespace
}  // namespace codesign
