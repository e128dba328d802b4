// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/poles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

constexpr double kTurn = 6.283185307179586;

/// x'' + 2 zeta w x' + w^2 x = 0.
StateSpace oscillator(double zeta, double w) {
  StateSpace system;
  system.A.resize(2, 2);
  system.A << 0.0, 1.0, -w * w, -2.0 * zeta * w;
  return system;
}

StateSpace scalar(double value, double period) {
  StateSpace system;
  system.period = period;
  system.A.setConstant(1, 1, value);
  return system;
}

TEST(Poles, OfADampedOscillator) {
  const std::vector<Pole> poles = poles_of(oscillator(0.1, 2.0));
  ASSERT_EQ(poles.size(), 1U) << "one of each pair";
  EXPECT_NEAR(poles[0].growth(), -0.2, 1e-14);
  EXPECT_NEAR(poles[0].frequency(), 2.0 * std::sqrt(0.99) / kTurn, 1e-14);
  EXPECT_NEAR(poles[0].damping_ratio(), 0.1, 1e-14);
  EXPECT_EQ(judge(poles, 10.0), Stability::kStable);
  EXPECT_EQ(decisive_text(poles, Stability::kStable, 0.0), "slowest pole -0.2 1/s");
}

TEST(Poles, JudgeBothSidesOfTheAxis) {
  for (const double zeta : {1e-9, 1e-6, 0.1})
    for (const double w : {1e-2, 1.0, 1e4}) {
      EXPECT_EQ(judge(poles_of(oscillator(zeta, w)), 10.0), Stability::kStable);
      EXPECT_EQ(judge(poles_of(oscillator(-zeta, w)), 10.0), Stability::kUnstable);
    }
  const std::vector<Pole> undamped = poles_of(oscillator(0.0, 3.0));
  EXPECT_EQ(judge(undamped, 10.0), Stability::kStable);
  EXPECT_EQ(decisive_text(undamped, Stability::kStable, 0.0), "undamped, 0.477465 Hz");
}

// A free body: a double pole, which rounding would split.
TEST(Poles, AFreeMotionIsNeutral) {
  EXPECT_EQ(judge(poles_of(oscillator(0.0, 0.0)), 10.0), Stability::kNeutral);
  StateSpace moved = oscillator(0.0, 0.0);
  moved.A(1, 0) = 1e-15;
  EXPECT_EQ(judge(poles_of(moved), 10.0), Stability::kNeutral);
  EXPECT_EQ(decisive_text(poles_of(moved), Stability::kNeutral, 0.0), "a motion without force");
  moved.A(1, 0) = 1e-3;
  EXPECT_EQ(judge(poles_of(moved), 10.0), Stability::kUnstable);
}

TEST(Poles, OfAPeriod) {
  const std::vector<Pole> poles = poles_of(scalar(0.5, 0.1));
  ASSERT_EQ(poles.size(), 1U);
  EXPECT_NEAR(poles[0].growth(), std::log(0.5) / 0.1, 1e-13);
  EXPECT_NEAR(poles[0].radius(0.1), 0.5, 1e-15);
  EXPECT_EQ(decisive_text(poles, Stability::kStable, 0.1),
            "slowest pole -6.93147 1/s, spectral radius 0.5 over 0.1 s");
  // A negative one alternates: half a turn per period.
  const std::vector<Pole> alternating = poles_of(scalar(-1.1, 0.1));
  EXPECT_NEAR(alternating[0].frequency(), 5.0, 1e-12);
  EXPECT_EQ(judge(alternating, 10.0), Stability::kUnstable);
  EXPECT_TRUE(poles_of(scalar(0.0, 0.1)).empty()) << "gone after a period";
}

}  // namespace
}  // namespace codesign
