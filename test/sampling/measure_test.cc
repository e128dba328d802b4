// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sampling/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/differences.h"
#include "sampling/samples.h"

namespace codesign {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

RobustOptions options(RobustMeasure measure, double number = 0.5) {
  RobustOptions result;
  result.measure = measure;
  result.level = result.factor = number;
  return result;
}
RobustOptions cvar(double level) { return options(RobustMeasure::kCvar, level); }

VectorXd vector(std::initializer_list<double> numbers) {
  return Eigen::Map<const VectorXd>(numbers.begin(), static_cast<Index>(numbers.size()));
}
VectorXd equal(Index size) { return VectorXd::Constant(size, 1.0 / static_cast<double>(size)); }

// The function that Rockafellar and Uryasev minimize; for finitely many values, one of the values
// is a minimum.
double minimum_over_threshold(double level, const VectorXd& values, const VectorXd& weights) {
  double least = std::numeric_limits<double>::infinity();
  for (const double t : values)
    least =
        std::min(least, t + weights.dot((values.array() - t).max(0.0).matrix()) / (1.0 - level));
  return least;
}

void expect_derivative(const RobustOptions& measured, const VectorXd& values,
                       const VectorXd& weights) {
  const Measured result = measure(measured, values, weights);
  EXPECT_NEAR(result.by_value.sum(), 1.0, 1e-15);
  for (Index i = 0; i < values.size(); ++i) {
    const auto along = [&](double x) {
      VectorXd moved = values;
      moved[i] = x;
      return measure(measured, moved, weights).value;
    };
    EXPECT_NEAR(result.by_value[i], ridders_derivative(along, values[i], 0.01).value, 1e-10) << i;
  }
}

const VectorXd kValues = vector({3.0, -1.0, 7.0, 2.0, 5.0});
const VectorXd kWeights = vector({0.1, 0.3, 0.2, 0.25, 0.15});

TEST(Measure, MeanIsTheWeightedSum) {
  const Measured mean = measure(options(RobustMeasure::kMean), kValues, kWeights);
  EXPECT_NEAR(mean.value, 0.3 - 0.3 + 1.4 + 0.5 + 0.75, 1e-15);
  EXPECT_EQ(mean.by_value, kWeights);
  EXPECT_TRUE(std::isnan(mean.threshold));
}

TEST(Measure, WorstIsTheFirstOfTheLargest) {
  const Measured worst =
      measure(options(RobustMeasure::kWorst), vector({1.0, 4.0, 2.0, 4.0}), equal(4));
  EXPECT_EQ(worst.value, 4.0);
  EXPECT_EQ(worst.threshold, 4.0);
  EXPECT_EQ(worst.by_value, vector({0.0, 1.0, 0.0, 0.0}));
}

TEST(Measure, CvarOfEqualWeights) {
  VectorXd values(10);
  values << 4, 9, 1, 0, 8, 3, 7, 2, 6, 5;
  const Measured tenth = measure(cvar(0.9), values, equal(10)),
                 half = measure(cvar(0.5), values, equal(10));
  EXPECT_EQ(tenth.value, 9.0);
  EXPECT_EQ(tenth.by_value, VectorXd::Unit(10, 1));
  EXPECT_EQ(tenth.threshold, 8.0);
  EXPECT_NEAR(half.value, 7.0, 1e-15);
  EXPECT_EQ(half.threshold, 4.0);
  // 1 - 0.7 is not 3 / 10: the fourth value does not count with the difference.
  EXPECT_EQ((measure(cvar(0.7), values, equal(10)).by_value.array() > 0.0).count(), 3);
}

// The worst 0.3 are 7 with its weight 0.2 and 5 with 0.1 of its weight 0.15.
TEST(Measure, CvarBetweenTwoAtomsTakesAPartOfOne) {
  const Measured result = measure(cvar(0.7), kValues, kWeights);
  EXPECT_NEAR(result.value, (0.2 * 7.0 + 0.1 * 5.0) / 0.3, 1e-14);
  EXPECT_NEAR((result.by_value - vector({0.0, 0.0, 2.0 / 3.0, 0.0, 1.0 / 3.0})).norm(), 0.0, 1e-14);
  EXPECT_EQ(result.threshold, 5.0);
}

TEST(Measure, CvarIsTheMinimumOverTheThreshold) {
  for (double level = 0.02; level < 1.0; level += 0.03) {
    EXPECT_NEAR(measure(cvar(level), kValues, kWeights).value,
                minimum_over_threshold(level, kValues, kWeights), 1e-13)
        << level;
  }
}

TEST(Measure, CvarOfASmallTailIsTheWorst) {
  const Measured result = measure(cvar(0.999), kValues, kWeights);
  EXPECT_EQ(result.value, 7.0);
  EXPECT_EQ(result.threshold, 7.0);
}

TEST(Measure, CvarWithTiesGivesASubgradient) {
  const Measured result = measure(cvar(0.5), vector({2.0, 2.0, 2.0, 1.0}), equal(4));
  EXPECT_EQ(result.value, 2.0);
  EXPECT_EQ(result.by_value, vector({0.5, 0.5, 0.0, 0.0}));
}

// Mean 2.65; sum of w psi^2: 0.9 + 0.3 + 9.8 + 1 + 3.75 = 15.75; variance 15.75 - 2.65^2 = 8.7275.
TEST(Measure, MeanPlusDeviation) {
  EXPECT_NEAR(measure(options(RobustMeasure::kMeanPlusDeviation, 2.0), kValues, kWeights).value,
              2.65 + 2.0 * std::sqrt(8.7275), 1e-14);
}

TEST(Measure, WithoutDeviationTheDerivativeIsThatOfTheMean) {
  const Measured result = measure(options(RobustMeasure::kMeanPlusDeviation, 3.0),
                                  VectorXd::Constant(7, 0.1), equal(7));
  EXPECT_EQ(result.value, 0.1);
  EXPECT_EQ(result.by_value, equal(7));
}

TEST(Measure, DerivativesAreThoseOfRidders) {
  for (const auto kind : {RobustMeasure::kMean, RobustMeasure::kWorst,
                          RobustMeasure::kMeanPlusDeviation, RobustMeasure::kCvar}) {
    expect_derivative(options(kind, 0.66), kValues, kWeights);
  }
  expect_derivative(options(RobustMeasure::kMeanPlusDeviation, 0.0), kValues, kWeights);
}

TEST(Measure, OfOneValueIsThatValue) {
  for (const auto kind : {RobustMeasure::kMean, RobustMeasure::kWorst,
                          RobustMeasure::kMeanPlusDeviation, RobustMeasure::kCvar}) {
    const Measured result = measure(options(kind, 0.9), vector({0.3}), vector({1.0}));
    EXPECT_EQ(result.value, 0.3);
    EXPECT_EQ(result.by_value, vector({1.0}));
  }
}

// Distance to a stop from 1 m/s under friction, psi = 1 / (2 mu g), with mu uniform in [0.2, 0.4]:
// the mean is ln(2) / (0.4 g), CVaR(0.9) ln(1.1) / (0.04 g), the supremum 1 / (0.4 g).
TEST(Measure, OfABrakingDistanceWithUncertainFriction) {
  constexpr int kCount = 4096;
  constexpr double kGravity = 9.81;
  const UncertainQuantity friction{
      "mu", 0, {DistributionKind::kUniform, 0.0, 0.0, 0.2, 0.4, {}}, {}, {}};
  const auto samples = draw({friction}, SamplerKind::kSobol, kCount, 1);
  VectorXd distance(kCount);
  for (Index i = 0; i < kCount; ++i)
    distance[i] = 1.0 / (2.0 * samples[static_cast<std::size_t>(i)][0] * kGravity);
  const auto measured = [&](RobustMeasure kind) {
    return measure(options(kind, 0.9), distance, equal(kCount)).value;
  };
  EXPECT_NEAR(measured(RobustMeasure::kMean) / (std::log(2.0) / (0.4 * kGravity)), 1.0, 1e-5);
  EXPECT_NEAR(measured(RobustMeasure::kCvar) / (std::log(1.1) / (0.04 * kGravity)), 1.0, 1e-3);
  EXPECT_NEAR(measured(RobustMeasure::kWorst) / (1.0 / (0.4 * kGravity)), 1.0, 1e-3);
}

TEST(Measure, TheWorstOfGroupsIsThatOfTheirMeans) {
  RobustOptions options;
  options.measure = RobustMeasure::kWorst;
  options.groups = {0, 1, 0, 1};
  const Eigen::Vector4d values(1.0, 8.0, 5.0, 2.0), weights(0.1, 0.1, 0.3, 0.5);
  const Measured measured = measure(options, values, weights);
  EXPECT_NEAR(measured.value, (0.1 * 1.0 + 0.3 * 5.0) / 0.4, 1e-15);
  EXPECT_TRUE(measured.by_value.isApprox(Eigen::Vector4d(0.25, 0.0, 0.75, 0.0)));
  Eigen::MatrixXd shares;
  const Eigen::VectorXd means = grouped(options, values, weights, &shares);
  EXPECT_NEAR(means[1], (0.1 * 8.0 + 0.5 * 2.0) / 0.6, 1e-15);
  EXPECT_TRUE(means.isApprox(shares * values));
  options.groups.clear();
  EXPECT_EQ(grouped(options, values, weights, &shares), values);
  EXPECT_TRUE(shares.isIdentity());
}

}  // namespace
}  // namespace codesign
