// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_newton.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

const std::vector<int> kBoth{0, 1};
const LoopSearch kSearch{kBoth, Posture::kRank, LoopRows::kAll};
const double kAngle = std::asin(0.6);

TEST(LoopNewton, ClosesALoopToRounding) {
  LoopsToClose c(triangle());
  LoopNewton newton(c.loops);
  Posture posture = c.at({-0.5, 0.5});
  EXPECT_EQ(newton.solve(c.design, kSearch, &posture), Closure::kClosed);
  EXPECT_NEAR(posture.theta[0], -kAngle, 1e-14);
  EXPECT_NEAR(posture.theta[1], kAngle, 1e-14);
  EXPECT_LT(size_of(posture.miss), 1e-14);
}

TEST(LoopNewton, SaysHowNearALoopComesThatCannotClose) {
  // The bars are 0.5 too short, and meet 2.5 - 2 apart when both are level.
  LoopsToClose c(triangle("2.5")), nearly(triangle("2.0005"));
  LoopNewton newton(c.loops), other(nearly.loops);
  Posture posture = c.at({-1.0, 1.0});
  EXPECT_EQ(newton.solve(c.design, kSearch, &posture), Closure::kApart);
  EXPECT_GE(posture.miss.length, 0.5);
  EXPECT_LT(posture.miss.length, 0.51);
  EXPECT_FALSE(newton.is_near(posture.miss));
  posture = nearly.at({-1.5, 1.5});
  EXPECT_EQ(other.solve(nearly.design, kSearch, &posture), Closure::kNear);
  EXPECT_TRUE(other.is_near(posture.miss));
}

TEST(LoopNewton, ConvergesAtOnceBesideASolutionOnly) {
  LoopsToClose c(triangle());
  LoopNewton newton(c.loops);
  Posture posture = c.at({-0.6, 0.6});
  EXPECT_TRUE(newton.converges_at_once(c.design, kBoth, LoopRows::kAll, &posture));
  EXPECT_NEAR(posture.theta[0], -kAngle, 1e-12);
  // The first step would turn both bars by 0.6 rad.
  posture = c.at({0.0, 0.0});
  EXPECT_FALSE(newton.converges_at_once(c.design, kBoth, LoopRows::kAll, &posture));
  EXPECT_EQ(posture.theta[0], 0.0);
}

TEST(LoopNewton, EndsWhenItIsCancelled) {
  LoopsToClose c(triangle());
  LoopNewton newton(c.loops);
  const std::atomic<bool> cancel{true};
  const StartDesign cancelled{c.design.parameters, c.design.equations, &cancel};
  Posture posture = c.at({-0.5, 0.5});
  EXPECT_EQ(newton.solve(cancelled, kSearch, &posture), Closure::kApart);
  EXPECT_FALSE(newton.converges_at_once(cancelled, kBoth, LoopRows::kAll, &posture));
  EXPECT_EQ(posture.theta[0], -0.5);
}

}  // namespace
}  // namespace codesign
