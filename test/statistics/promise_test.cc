// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/conditional_normal.h"
#include "math/dense.h"
#include "sampling/measure.h"
#include "sampling/samples.h"
#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

constexpr int kRobots = 200, kTimes = 600, kSamples = 256;
constexpr double kLevel = 0.9;

using Numbers = Eigen::Vector2d;

/// Three terms of a recorded effort: two friction coefficients, which are hard to distinguish, and
/// an offset of the sensor.
Eigen::MatrixXd regressors() {
  Eigen::MatrixXd terms(kTimes, 3);
  for (int k = 0; k < kTimes; ++k) {
    const double speed = std::sin(0.05 * k) + 0.4 * std::sin(0.113 * k);
    terms.row(k) << std::tanh(8.0 * speed), speed, 1.0;
  }
  return terms;
}

/// The distribution of the two coefficients that one recording of a robot leaves, as
/// `uncertain.from` has it.
std::vector<UncertainQuantity> identified(const Numbers& robot, std::mt19937* random) {
  static const Eigen::MatrixXd kTerms = regressors();
  std::normal_distribution<double> normal;
  Eigen::VectorXd effort = kTerms.leftCols(2) * robot;
  double noise = normal(*random);
  for (double& one : effort) {
    noise = 0.8 * noise + 0.6 * normal(*random);
    one += 0.1 + 0.3 * noise;
  }
  const Eigen::VectorXd fit = least_norm(kTerms).solve(effort);
  const ParameterCovariance known =
      parameter_covariance(kTerms * fit - effort, kTerms, {kTimes}, {});
  const auto given = conditional_normal(known.covariance.topLeftCorner(2, 2));
  std::vector<UncertainQuantity> quantities(2);
  for (Eigen::Index i = 0; i < 2; ++i) {
    UncertainQuantity& quantity = quantities[static_cast<std::size_t>(i)];
    quantity.distribution = {
        DistributionKind::kNormal, fit[i], given->deviations[i], -10.0, 10.0, {}};
    if (i > 0) quantity.slopes = {{0, given->slopes(1, 0)}};
  }
  return quantities;
}

/// The cost of a robot that runs with friction.
double objective(const Numbers& robot) {
  return 3.0 * robot[0] + 2.0 * robot[1] + 0.5 * robot.squaredNorm();
}

double bound_of(const std::vector<UncertainQuantity>& quantities) {
  Eigen::VectorXd values(kSamples);
  Eigen::Index k = 0;
  for (const std::vector<double>& sample : draw(quantities, SamplerKind::kSobol, kSamples, 3))
    values[k++] = objective({sample[0], sample[1]});
  RobustOptions options;
  options.measure = RobustMeasure::kCvar;
  options.level = kLevel;
  return measure(options, values, Eigen::VectorXd::Constant(kSamples, 1.0 / kSamples)).threshold;
}

/// Robots around one truth, each identified from a recording of its own, each with a promise of its
/// own; doc/theory.md (24h).
TEST(Promise, IsKeptByAsManyRobotsAsItSays) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int kept = 0;
  for (int robot = 0; robot < kRobots; ++robot) {
    const Numbers truth(0.8 + 0.05 * normal(random), 0.5 + 0.05 * normal(random));
    if (objective(truth) <= bound_of(identified(truth, &random))) ++kept;
  }
  EXPECT_GE(kept, 170);
  EXPECT_LE(kept, 190);
}

/// Without correlations the distribution is another one, and so is the bound.
TEST(Promise, NeedsTheCorrelations) {
  std::mt19937 random(11);
  std::vector<UncertainQuantity> quantities = identified({0.8, 0.5}, &random);
  const double bound = bound_of(quantities);
  const UncertainQuantity& first = quantities[0];
  const double slope = quantities[1].slopes[0].slope;
  quantities[1].distribution.deviation =
      std::hypot(quantities[1].distribution.deviation, slope * first.distribution.deviation);
  quantities[1].slopes.clear();
  const double nominal = objective({first.distribution.mean, quantities[1].distribution.mean});
  EXPECT_LT(slope, 0.0) << "one coefficient can do the other's work";
  EXPECT_GT(bound_of(quantities) - nominal, 1.2 * (bound - nominal));
}

}  // namespace
}  // namespace codesign
