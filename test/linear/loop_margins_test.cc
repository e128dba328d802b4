// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/loop_margins.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

constexpr double kHalf = 3.141592653589793;

/// The closed loop of L = gain b(s)/a(s), a monic, b and a by rising powers: H = -L/(1 + L).
StateSpace closed_loop(const std::vector<double>& b, const std::vector<double>& a,
                       double period = 0.0) {
  const auto n = static_cast<Eigen::Index>(a.size());
  StateSpace system;
  system.period = period;
  system.A = Eigen::MatrixXd::Zero(n, n);
  system.A.topRightCorner(n - 1, n - 1).setIdentity();
  system.B = Eigen::MatrixXd::Zero(n, 1);
  system.B(n - 1, 0) = 1.0;
  system.C = Eigen::MatrixXd::Zero(1, n);
  system.D = Eigen::MatrixXd::Zero(1, 1);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double b_k = at < b.size() ? b[at] : 0.0;
    system.A(n - 1, k) = -a[at] - b_k;
    system.C(0, k) = -b_k;
  }
  return system;
}

TEST(LoopMargins, OfAnIntegratorWithTwoLags) {
  // 2/(s (s + 1) (s + 2)): L(j sqrt 2) = -1/3.
  const LoopMargins margins = OpenLoop(closed_loop({2.0}, {0.0, 2.0, 3.0})).margins();
  EXPECT_TRUE(margins.is_stable);
  EXPECT_NEAR(margins.gain_margin->value, 3.0, 1e-10);
  EXPECT_NEAR(margins.gain_margin->frequency, std::sqrt(2.0), 1e-10);
  EXPECT_FALSE(margins.gain_reduction);
  // w^2 (w^2 + 1) (w^2 + 4) = 4
  const double w = margins.phase_margin->frequency, u = w * w;
  EXPECT_NEAR(u * (u + 1.0) * (u + 4.0), 4.0, 1e-9);
  const double phase = kHalf / 2.0 - std::atan(w) - std::atan(w / 2.0);
  EXPECT_NEAR(margins.phase_margin->value, phase, 1e-10);
  EXPECT_NEAR(margins.delay_margin->value, phase / w, 1e-10);
}

TEST(LoopMargins, OfThreeEqualLags) {
  // 1/(s + 1)^3: L(j sqrt 3) = -1/8, and no gain of 1.
  const LoopMargins margins = OpenLoop(closed_loop({1.0}, {1.0, 3.0, 3.0})).margins();
  EXPECT_NEAR(margins.gain_margin->value, 8.0, 1e-10);
  EXPECT_NEAR(margins.gain_margin->frequency, std::sqrt(3.0), 1e-10);
  EXPECT_FALSE(margins.phase_margin);
  EXPECT_FALSE(margins.delay_margin);
}

TEST(LoopMargins, PeaksOfASecondOrderLoop) {
  // L = w0^2/(s (s + 2 zeta w0)): T has the peak 1/(2 zeta sqrt(1 - zeta^2)), theory of lags.
  const double zeta = 0.3, w0 = 5.0;
  const LoopMargins margins = OpenLoop(closed_loop({w0 * w0}, {0.0, 2.0 * zeta * w0})).margins();
  EXPECT_NEAR(margins.complementary->value, 1.0 / (2.0 * zeta * std::sqrt(1.0 - zeta * zeta)),
              1e-10);
  EXPECT_NEAR(margins.complementary->frequency, w0 * std::sqrt(1.0 - 2.0 * zeta * zeta), 1e-6);
  // |T|^2 = 1/2: (1 - u)^2 + 4 zeta^2 u = 2 with u = (w/w0)^2
  const double half = 1.0 - 2.0 * zeta * zeta;
  EXPECT_NEAR(margins.bandwidth->value, w0 * std::sqrt(half + std::sqrt(half * half + 1.0)), 1e-9);
  EXPECT_NEAR(margins.phase_margin->value,
              std::atan(2.0 * zeta /
                        std::sqrt(std::sqrt(1.0 + 4.0 * std::pow(zeta, 4)) - 2.0 * zeta * zeta)),
              1e-10);
  EXPECT_FALSE(margins.gain_margin);
}

// S of an integrator is below 1 and tends to it.
TEST(LoopMargins, OfAnIntegrator) {
  const LoopMargins margins = OpenLoop(closed_loop({3.0}, {0.0})).margins();
  EXPECT_EQ(margins.sensitivity->value, 1.0);
  EXPECT_NEAR(margins.bandwidth->value, 3.0, 1e-9);
  EXPECT_NEAR(margins.delay_margin->value, kHalf / 6.0, 1e-9);
}

TEST(LoopMargins, OfAnUnstablePlant) {
  // 3/(s - 1): stable, and the gain may fall to a third.
  const LoopMargins margins = OpenLoop(closed_loop({3.0}, {-1.0})).margins();
  EXPECT_TRUE(margins.is_stable);
  EXPECT_FALSE(margins.gain_margin);
  EXPECT_NEAR(margins.gain_reduction->value, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(margins.phase_margin->value, std::atan(std::sqrt(8.0)), 1e-10);
}

TEST(LoopMargins, AnUnstableLoopHasNothingToSpare) {
  const LoopMargins margins = OpenLoop(closed_loop({8.0}, {0.0, 2.0, 3.0})).margins();
  EXPECT_FALSE(margins.is_stable);
  EXPECT_FALSE(margins.gain_margin);
  EXPECT_FALSE(margins.delay_margin);
  EXPECT_FALSE(margins.phase_margin);
  EXPECT_FALSE(margins.sensitivity);
  EXPECT_NEAR(margins.gain_reduction->value, 0.75, 1e-10) << "at which it would be stable";
  // 1/(s - 1) with half of the gain that it needs: less of it does not help.
  EXPECT_FALSE(OpenLoop(closed_loop({0.5}, {-1.0})).margins().gain_reduction);
}

/// From w to C/(s - A) w + D w.
StateSpace first_order(double A, double C, double D) {
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  StateSpace system;
  system.A = one(A);
  system.B = one(1.0);
  system.C = one(C);
  system.D = one(D);
  return system;
}

// (-s/2 + 3)/(s + 1) has 1 + k L = ((1 - k/2) s + 1 + 3 k)/(s + 1): a limit at infinite frequency.
// (-3/2 s - 3)/(s + 1) may fall to 2/3, (-3/2 s + 9)/(s + 1) has to, (2 s + 3)/(s + 1) has none.
TEST(LoopMargins, OfAnOutputThatDependsOnItselfAtOnce) {
  const LoopMargins below = OpenLoop(first_order(-8.0, -14.0, 1.0)).margins();
  EXPECT_TRUE(below.is_stable);
  EXPECT_NEAR(below.gain_margin->value, 2.0, 1e-14);
  EXPECT_NEAR(below.sensitivity->value, 2.0, 1e-14) << "1 + D";
  EXPECT_FALSE(below.gain_reduction);
  EXPECT_GT(below.delay_margin->value, 0.0);
  const LoopMargins beyond = OpenLoop(first_order(-4.0, 6.0, -3.0)).margins();
  EXPECT_TRUE(beyond.is_stable);
  EXPECT_NEAR(beyond.complementary->value, 3.0, 1e-14) << "|D|";
  EXPECT_NEAR(beyond.gain_reduction->value, 2.0 / 3.0, 1e-14);
  EXPECT_EQ(beyond.delay_margin->value, 0.0) << "fast signals grow with any delay";
  const LoopMargins unstable = OpenLoop(first_order(20.0, -42.0, -3.0)).margins();
  EXPECT_FALSE(unstable.is_stable || unstable.delay_margin);
  EXPECT_NEAR(unstable.gain_reduction->value, 2.0 / 3.0, 1e-14);
  const LoopMargins none = OpenLoop(first_order(-4.0 / 3.0, -1.0 / 9.0, -2.0 / 3.0)).margins();
  EXPECT_FALSE(none.gain_margin || none.gain_reduction || none.phase_margin);
  EXPECT_EQ(none.delay_margin->value, 0.0);
}

TEST(LoopMargins, OfASampledIntegrator) {
  // k/(z - 1): |L| = 1 at 2 sin(w T/2) = k; L(-1) = -k/2.
  const double period = 0.1, k = 0.5;
  const LoopMargins margins = OpenLoop(closed_loop({k}, {-1.0}, period)).margins();
  EXPECT_NEAR(margins.gain_margin->value, 2.0 / k, 1e-12);
  EXPECT_NEAR(margins.gain_margin->frequency, kHalf / period, 1e-9);
  const double w = 2.0 * std::asin(k / 2.0) / period;
  EXPECT_NEAR(margins.phase_margin->frequency, w, 1e-9);
  EXPECT_NEAR(margins.phase_margin->value, kHalf / 2.0 - 0.5 * w * period, 1e-10);
  // With one sample of delay, k/(z (z - 1)): the limit is k = 1, at a sixth of a turn per sample.
  const LoopMargins late = OpenLoop(closed_loop({k}, {0.0, -1.0}, period)).margins();
  EXPECT_NEAR(late.gain_margin->value, 1.0 / k, 1e-10);
  EXPECT_NEAR(late.gain_margin->frequency, kHalf / 3.0 / period, 1e-9);
}

}  // namespace
}  // namespace codesign
