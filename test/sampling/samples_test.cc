// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sampling/sampler.h"
#include "sampling/samples.h"

namespace codesign {
namespace {

UncertainQuantity quantity(const Distribution& distribution) {
  return {"quantity", 0, distribution, {}, {}};
}

std::vector<UncertainQuantity> quantities() {
  return {quantity({DistributionKind::kUniform, 0.0, 0.0, 0.2, 0.4, {}}),
          quantity({DistributionKind::kNormal, 1.0, 0.1, 0.7, 1.3, {}}),
          quantity({DistributionKind::kChoice, 0.0, 0.0, 0.0, 0.0, {0.0, 1.0, 2.0, 3.0}})};
}

TEST(Samples, AreQuantilesOfUnitPoints) {
  const auto samples = draw(quantities(), SamplerKind::kLatinHypercube, 6, 9);
  const Eigen::MatrixXd points = unit_points(SamplerKind::kLatinHypercube, 6, 3, 9);
  ASSERT_EQ(samples.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    ASSERT_EQ(samples[i].size(), 3u);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(samples[i][j],
                quantile(quantities()[j].distribution,
                         points(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j))));
    }
  }
}

TEST(Samples, AtCornersHaveBothEndsAndAllChoices) {
  const auto at = corners(quantities());
  ASSERT_EQ(at.size(), 8u);
  int ends[2] = {0, 0};
  std::vector<int> chosen(4, 0);
  for (const auto& sample : at) {
    ++ends[sample[0] < 0.3 ? 0 : 1];
    EXPECT_NEAR(std::abs(sample[0] - 0.3), 0.1, 1e-10);
    EXPECT_NEAR(sample[1], 1.0, 1e-15) << "the mean";
    ++chosen[static_cast<std::size_t>(sample[2])];
  }
  EXPECT_EQ(ends[0], 4);
  EXPECT_EQ(chosen, std::vector<int>(4, 2));
  EXPECT_TRUE(corners({quantities()[1], quantities()[2]}).empty()) << "no interval";
  EXPECT_EQ(corners(std::vector<UncertainQuantity>(6, quantities()[0])).size(), 64u);
  EXPECT_TRUE(corners(std::vector<UncertainQuantity>(7, quantities()[0])).empty());
}

TEST(Samples, HaveTheMeansOfTheirDistributions) {
  double uniform = 0.0, normal = 0.0;
  std::vector<int> chosen(4, 0);
  for (const auto& sample : draw(quantities(), SamplerKind::kSobol, 256, 1)) {
    uniform += sample[0] / 256.0;
    normal += sample[1] / 256.0;
    ++chosen[static_cast<std::size_t>(sample[2])];
  }
  EXPECT_NEAR(uniform, 0.3, 1e-4);
  EXPECT_NEAR(normal, 1.0, 1e-4);
  EXPECT_EQ(chosen, std::vector<int>(4, 64));
}

TEST(Samples, OneIsDrawnLikeTheFirstOfMany) {
  const auto one = draw(quantities(), SamplerKind::kSobol, 1, 4),
             many = draw(quantities(), SamplerKind::kSobol, 8, 4);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0], many[0]);
}

TEST(Samples, OfNothingAreEmptyRows) {
  EXPECT_EQ(draw({}, SamplerKind::kSobol, 3, 1), std::vector<std::vector<double>>(3));
}

/// Two correlated numbers, doc/theory.md (24h): deviations 0.1 and 0.2, correlation 0.8.
std::vector<UncertainQuantity> correlated(double lower, double upper) {
  UncertainQuantity first = quantity({DistributionKind::kNormal, 1.0, 0.1, lower, upper, {}});
  UncertainQuantity second =
      quantity({DistributionKind::kNormal, -3.0, 0.2 * 0.6, -10.0, 10.0, {}});
  second.slopes = {{0, 0.8 * 2.0}};
  return {first, second};
}

TEST(Samples, HaveTheCovarianceOfCorrelatedNumbers) {
  for (const SamplerKind sampler :
       {SamplerKind::kSobol, SamplerKind::kLatinHypercube, SamplerKind::kRandom}) {
    constexpr int kCount = 4096;
    const double tolerance = sampler == SamplerKind::kRandom ? 0.05 : 0.02;
    double mean[2] = {}, square[3] = {};
    for (const auto& sample : draw(correlated(-10.0, 10.0), sampler, kCount, 5)) {
      const double a = (sample[0] - 1.0) / 0.1, b = (sample[1] + 3.0) / 0.2;
      mean[0] += a / kCount;
      mean[1] += b / kCount;
      square[0] += a * a / kCount;
      square[1] += b * b / kCount;
      square[2] += a * b / kCount;
    }
    EXPECT_NEAR(mean[0], 0.0, tolerance);
    EXPECT_NEAR(mean[1], 0.0, tolerance);
    EXPECT_NEAR(square[0], 1.0, tolerance);
    EXPECT_NEAR(square[1], 1.0, tolerance);
    EXPECT_NEAR(square[2], 0.8, tolerance);
  }
}

TEST(Samples, OfATruncatedNumberMoveTheOthersWithIt) {
  double second = 0.0;
  for (const auto& sample : draw(correlated(1.0, 10.0), SamplerKind::kSobol, 4096, 5)) {
    EXPECT_GE(sample[0], 1.0);
    second += sample[1] / 4096.0;
  }
  // The mean of the upper half of a normal distribution is sqrt(2 / pi) deviations above its
  // middle.
  EXPECT_NEAR(second, -3.0 + 1.6 * 0.1 * std::sqrt(2.0 / M_PI), 1e-3);
}

TEST(Samples, ANumberWithoutDeviationIsItsMean) {
  UncertainQuantity known = quantity({DistributionKind::kNormal, 0.7, 0.0, 0.0, 1.0, {}});
  for (const auto& sample : draw({known}, SamplerKind::kRandom, 4, 1)) EXPECT_EQ(sample[0], 0.7);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Distribution normal(double mean, double deviation, double lower = -kInfinity,
                    double upper = kInfinity) {
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
  for (double u = 1e-300; u < 0.5; u *= 3.0)
    EXPECT_NEAR(exceedance(-quantile(normal(0, 1), u)) / u, 1.0, 1e-12) << u;
  for (double rest = 0.4; rest > 1e-15; rest *= 0.5) {
    const double u = 1.0 - rest;
    EXPECT_NEAR(exceedance(quantile(normal(0, 1), u)) / (1.0 - u), 1.0, 1e-13) << u;
  }
}

TEST(Quantile, OfTruncatedTailsKeepsItsDigits) {
  const double above = exceedance(5.0), beyond = exceedance(8.0);
  for (const double u : {1e-9, 0.1, 0.5, 0.9, 1.0 - 1e-9}) {
    const double x = quantile(normal(0, 1, 5.0, 8.0), u),
                 mirrored = quantile(normal(0, 1, -8.0, -5.0), 1.0 - u);
    EXPECT_GE(x, 5.0);
    EXPECT_LE(x, 8.0);
    EXPECT_NEAR((exceedance(x) - beyond) / ((1.0 - u) * (above - beyond)), 1.0, 1e-12 / (1.0 - u))
        << u;
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
  for (const Distribution& d : {normal(0, 1), normal(0, 1, -0.5, 3.0), normal(0, 1, 6.0, 7.0),
                                normal(2, 0.1, -kInfinity, 2.0)}) {
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
  const Distribution choice{
      DistributionKind::kChoice, 0.0, 0.0, -kInfinity, kInfinity, {7.0, 5.0, 6.0}};
  EXPECT_EQ(quantile(choice, 0.0), 7.0);
  EXPECT_EQ(quantile(choice, 0.333), 7.0);
  EXPECT_EQ(quantile(choice, 0.334), 5.0);
  EXPECT_EQ(quantile(choice, 0.667), 6.0);
  EXPECT_EQ(quantile(choice, 1.0 - 0x1p-53), 6.0);
}

}  // namespace

}  // namespace codesign
