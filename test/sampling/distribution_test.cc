// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Distribution normal(double mean, double deviation, double lower = -kInfinity, double upper = kInfinity) {
  return {DistributionKind::kNormal, mean, deviation, lower, upper, {}};
}

// Probability that a standard normal number exceeds x.
double exceedance(double x) { return 0.5 * std::erfc(x / std::sqrt(2.0)); }

TEST(Quantile, OfAUniformDistributionIsLinear) {
  const Distribution uniform{DistributionKind::kUniform, 0.0, 0.0, -1.0, 3.0, {}};
  EXPECT_EQ(quantile(uniform, 0.0), -1.0);
  EXPECT_EQ(quantile(uniform, 0.25), 0.0);
  EXPECT_EQ(quantile(uniform, 0.875), 2.5);
}

// To 16 digits; 1e-20 from Wichura's algorithm AS 241.
TEST(Quantile, OfTheNormalDistributionIsThatOfTables) {
  EXPECT_NEAR(quantile(normal(0, 1), 0.5), 0.0, 1e-16);
  EXPECT_NEAR(quantile(normal(0, 1), 0.975), 1.959963984540054, 4e-15);
  EXPECT_NEAR(quantile(normal(0, 1), 0.025), -1.959963984540054, 4e-15);
  EXPECT_NEAR(quantile(normal(0, 1), 0.75), 0.6744897501960817, 2e-15);
  EXPECT_NEAR(quantile(normal(0, 1), 1e-3), -3.090232306167813, 6e-15);
  EXPECT_NEAR(quantile(normal(0, 1), 1e-20), -9.262340089798408, 2e-14);
  EXPECT_NEAR(quantile(normal(10, 2), 0.975), 13.919927969080108, 1e-14);
}

TEST(Quantile, GoesBackToTheProbability) {
  for (double u = 1e-300; u < 0.5; u *= 3.0) EXPECT_NEAR(exceedance(-quantile(normal(0, 1), u)) / u, 1.0, 1e-12) << u;
  for (double rest = 0.4; rest > 1e-15; rest *= 0.5) {
    const double u = 1.0 - rest;
    EXPECT_NEAR(exceedance(quantile(normal(0, 1), u)) / (1.0 - u), 1.0, 1e-13) << u;
  }
}

TEST(Quantile, OfTruncatedTailsKeepsItsDigits) {
  const double above = exceedance(5.0), beyond = exceedance(8.0);
  for (const double u : {1e-9, 0.1, 0.5, 0.9, 1.0 - 1e-9}) {
    const double x = quantile(normal(0, 1, 5.0, 8.0), u), mirrored = quantile(normal(0, 1, -8.0, -5.0), 1.0 - u);
    EXPECT_GE(x, 5.0);
    EXPECT_LE(x, 8.0);
    EXPECT_NEAR((exceedance(x) - beyond) / ((1.0 - u) * (above - beyond)), 1.0, 1e-12 / (1.0 - u)) << u;
    EXPECT_NEAR(mirrored, -x, 1e-14 * x) << u;
  }
}

TEST(Quantile, OfATruncatedNormalDistributionStaysBetweenItsBounds) {
  const Distribution d = normal(1.0, 0.5, 0.8, 2.0);
  const double from = exceedance(-0.4), to = exceedance(2.0);
  for (double u = 0.0; u <= 1.0; u += 0.0625) {
    const double x = quantile(d, u);
    EXPECT_GE(x, 0.8);
    EXPECT_LE(x, 2.0);
    EXPECT_NEAR((from - exceedance((x - 1.0) / 0.5)) / (from - to), u, 1e-14);
  }
}

TEST(Quantile, NeverFalls) {
  for (const Distribution& d : {normal(0, 1), normal(0, 1, -0.5, 3.0), normal(0, 1, 6.0, 7.0), normal(2, 0.1, -kInfinity, 2.0)}) {
    double last = -kInfinity;
    for (int i = 1; i < 4096; ++i) {
      const double x = quantile(d, i / 4096.0);
      EXPECT_GT(x, last) << i;
      last = x;
    }
  }
}

TEST(Quantile, AtTheEndsIsABound) {
  EXPECT_EQ(quantile(normal(0, 1), 0.0), -kInfinity);
  EXPECT_EQ(quantile(normal(0, 1), 1.0), kInfinity);
  EXPECT_NEAR(quantile(normal(0, 1, -2.0, 1.0), 0.0), -2.0, 1e-14);
  EXPECT_NEAR(quantile(normal(0, 1, -2.0, 1.0), 1.0), 1.0, 1e-14);
}

TEST(Quantile, WithoutProbabilityBetweenTheBoundsIsTheNearestBound) {
  EXPECT_EQ(quantile(normal(0, 1, 50.0, 60.0), 0.7), 50.0);
  EXPECT_EQ(quantile(normal(0, 1, -60.0, -50.0), 0.7), -50.0);
  EXPECT_EQ(quantile(normal(0, 1, 0.5, 0.5), 0.3), 0.5);
}

TEST(Quantile, OfAChoiceDividesTheIntervalEvenly) {
  const Distribution choice{DistributionKind::kChoice, 0.0, 0.0, -kInfinity, kInfinity, {7.0, 5.0, 6.0}};
  EXPECT_EQ(quantile(choice, 0.0), 7.0);
  EXPECT_EQ(quantile(choice, 0.333), 7.0);
  EXPECT_EQ(quantile(choice, 0.334), 5.0);
  EXPECT_EQ(quantile(choice, 0.667), 6.0);
  EXPECT_EQ(quantile(choice, 1.0 - 0x1p-53), 6.0);
}

}  // namespace
}  // namespace codesign
