// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/scaling.h"
#include "description/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Tuned, in this order: a gain bounded from below only, a length between bounds, an offset that
/// starts at zero. Mass stays.
Study study() {
  Study study;
  study.parameters = {{"length", 0.08, 0.06, 0.1, "m", {}},
                      {"mass", 2.0, 1.0, 3.0, "kg", {}},
                      {"gain", -500.0, -1000.0, kInfinity, "", {}},
                      {"offset", 0.0, -kInfinity, kInfinity, "", {}}};
  study.tuned = {2, 0, 3};
  return study;
}

TEST(Scaling, BoundsBecomeZeroAndOne) {
  const Study s = study();
  const Scaling scaling(s);
  EXPECT_EQ(scaling.lower()[1], 0.0);
  EXPECT_EQ(scaling.upper()[1], 1.0);
  EXPECT_NEAR(scaling.to_scaled(scaling.start())[1], 0.5, 1e-14);
}

TEST(Scaling, WithoutBothBoundsTheStartIsTheMeasure) {
  const Study s = study();
  const Scaling scaling(s);
  EXPECT_EQ(scaling.range(0), 500.0);
  EXPECT_EQ(scaling.to_scaled(scaling.start())[0], -1.0);
  EXPECT_EQ(scaling.lower()[0], -2.0);
  EXPECT_EQ(scaling.upper()[0], kInfinity);
  EXPECT_EQ(scaling.range(2), 1.0) << "a start of zero measures nothing";
}

// A start of zero has no size, so that value and slope tell it; a start far from zero has one.
TEST(Scaling, AReachBeginsAtTheSizeThatIsKnown) {
  const Study s = study();
  Scaling scaling(s);
  EXPECT_TRUE(scaling.reach(2, 0.0, 1e9));
  EXPECT_EQ(scaling.range(2), 1e9);
  EXPECT_TRUE(scaling.reach(2, 2e-6, 1e-7));
  EXPECT_EQ(scaling.range(2), 2e-6);
  EXPECT_TRUE(scaling.reach(2, 0.0, 0.0));
  EXPECT_EQ(scaling.range(2), 1.0) << "nothing is known";
  EXPECT_FALSE(scaling.reach(0, 123.0, 1e-7));
  EXPECT_EQ(scaling.range(0), 500.0);
  EXPECT_TRUE(scaling.reach(0, 123.0, 1e20));
  EXPECT_EQ(scaling.range(0), 500.0 * 1e10) << "slopes that are rounding";
}

TEST(Scaling, BackIsTheInverseAndNeverLeavesTheBounds) {
  const Study s = study();
  const Scaling scaling(s);
  const Eigen::Vector3d rho(123.0, 0.0734, -4.0);
  EXPECT_LT((scaling.from_scaled(scaling.to_scaled(rho)) - rho).norm(), 1e-13);
  EXPECT_EQ(scaling.from_scaled({-9.0, 1.0 + 1e-12, 0.0}), Eigen::Vector3d(-1000.0, 0.1, 0.0));
}

TEST(Scaling, GradientFollowsTheChainRule) {
  const Study s = study();
  const Scaling scaling(s);
  // psi = 2 gain + 3 length - offset, linear: its change along a scaled step is the scaled
  // gradient's.
  const Eigen::Vector3d gradient(2.0, 3.0, -1.0);
  const std::vector<double> scaled = scaling.scale_gradient(gradient), x{0.1, 0.2, 0.3},
                            y{0.2, 0.7, -1.0};
  double change = 0.0;
  for (std::size_t k = 0; k < 3; ++k) change += scaled[k] * (y[k] - x[k]);
  EXPECT_NEAR(change, gradient.dot(scaling.from_scaled(y) - scaling.from_scaled(x)), 1e-12);
  EXPECT_NEAR(scaling.gradient_norm(gradient), std::sqrt(1000.0 * 1000.0 + 0.12 * 0.12 + 1.0),
              1e-9);
}

}  // namespace
}  // namespace codesign
