// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/state_feedback.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

const Eigen::Matrix2d kDoubleIntegrator = (Eigen::Matrix2d() << 0.0, 1.0, 0.0, 0.0).finished();
const Eigen::Vector2d kForce(0.0, 1.0);

// k1 = r^-1/2, k2 = sqrt 2 r^-1/4 for the weights (1, 0).
TEST(StateFeedback, LqrOfADoubleIntegrator) {
  const Eigen::Matrix2d Q = Eigen::Vector2d(1.0, 0.0).asDiagonal();
  for (const double r : {1e-4, 0.3, 1.0, 50.0}) {
    const auto gains = lqr_gains(kDoubleIntegrator, kForce, Q, r);
    ASSERT_TRUE(gains);
    EXPECT_NEAR((*gains)[0], std::pow(r, -0.5), 1e-11 * std::pow(r, -0.5));
    EXPECT_NEAR((*gains)[1], std::sqrt(2.0) * std::pow(r, -0.25), 1e-11 * std::pow(r, -0.25));
  }
}

TEST(StateFeedback, PolesOfADoubleIntegrator) {
  const auto gains = gains_of_poles(kDoubleIntegrator, kForce, {{-1.0, 2.0}, {-1.0, -2.0}});
  ASSERT_TRUE(gains);
  EXPECT_NEAR((*gains)[0], 5.0, 1e-13);
  EXPECT_NEAR((*gains)[1], 2.0, 1e-13);
}

TEST(StateFeedback, TellsWhatIsOutOfReach) {
  const Eigen::Matrix2d two = Eigen::Vector2d(1.0, 2.0).asDiagonal();
  const Eigen::Vector2d of_one(1.0, 0.0);
  EXPECT_FALSE(gains_of_poles(two, of_one, {-1.0, -2.0}));
  EXPECT_FALSE(lqr_gains(two, of_one, Eigen::Matrix2d::Identity(), 1.0));
}

}  // namespace
}  // namespace codesign
