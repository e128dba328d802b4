// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/posture_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// A walk of the triangle from its length 1 to another one, and how it ended.
struct Stretch {
  LoopsToClose c{triangle()};
  LoopNewton newton{c.loops};
  PostureWay way;
  Posture posture;
  int arrivals = 0;
  bool reached;

  explicit Stretch(double length) {
    const double angle = std::asin(0.6);
    posture = c.at({-angle, angle});
    way.last = posture.theta;
    const std::vector<int> free{0, 1};
    std::vector<double> between{1.0};
    const auto place_at = [&](double part) -> const std::vector<double>& {
      between = {1.0 + part * (length - 1.0)};
      c.compiled.equations.set_design(between);
      return between;
    };
    reached = PostureWalk(c.loops, c.design, free, place_at, &newton)
                  .go(
                      1.0, [this] { ++arrivals; }, &posture, &way);
  }
};

TEST(PostureWalk, FollowsTheLoopAlongALine) {
  const Stretch stretch(1.5);
  ASSERT_TRUE(stretch.reached);
  // The law of cosines at the left hinge, whose bar is level at an angle of -pi / 2.
  const double inner = std::acos((1.0 + 1.44 - 2.25) / 2.4);
  EXPECT_NEAR(stretch.posture.theta[0], inner - 0.5 * M_PI, 1e-12);
  EXPECT_EQ(stretch.way.last, stretch.posture.theta);
  EXPECT_GE(stretch.arrivals, 1);
}

TEST(PostureWalk, EndsWhereTheLoopOpens) {
  // Beyond 2.2 the right bar is longer than the way round by the other two.
  const Stretch stretch(2.5);
  EXPECT_FALSE(stretch.reached);
  EXPECT_GE(stretch.arrivals, 1);
  // Both bars nearly in a line.
  EXPECT_NEAR(std::abs(std::remainder(stretch.way.last[0] - 0.5 * M_PI, 2.0 * M_PI)), 0.0, 0.2);
  EXPECT_GT(stretch.way.slope.norm(), 1.0);
}

TEST(PostureWalk, WithoutAStepHasNoSlope) {
  Stretch stretch(1.0);
  const std::vector<int> free{0, 1};
  const std::vector<double> parameters{2.5};
  stretch.c.compiled.equations.set_design(parameters);
  const auto place_at = [&](double) -> const std::vector<double>& { return parameters; };
  PostureWay way{stretch.posture.theta, {}, {}};
  EXPECT_FALSE(PostureWalk(stretch.c.loops, stretch.c.design, free, place_at, &stretch.newton)
                   .go(
                       1.0, [] { ADD_FAILURE(); }, &stretch.posture, &way));
  EXPECT_EQ(way.slope, Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace codesign
