// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

ProfileProblem at(double optimum, double threshold, double step) {
  ProfileProblem problem;
  problem.optimum = optimum;
  problem.cost = 5.0;
  problem.threshold = threshold;
  problem.step = step;
  return problem;
}

TEST(Profile, OfAQuadraticIsTheLinearInterval) {
  const ProfiledCost cost = [](double x) { return 5.0 + 4.0 * (x - 2.0) * (x - 2.0); };
  const ProfileInterval exact = profile_interval(at(2.0, 1.0, 0.5), cost);
  EXPECT_NEAR(exact.lower, 1.5, 1e-4);
  EXPECT_NEAR(exact.upper, 2.5, 1e-4);
  EXPECT_EQ(exact.evaluations, 2);
  const ProfileInterval far = profile_interval(at(2.0, 1.0, 0.03), cost);
  EXPECT_NEAR(far.lower, 1.5, 1e-4);
  EXPECT_NEAR(far.upper, 2.5, 1e-4);
  EXPECT_LE(far.evaluations, 14);
  EXPECT_EQ(far.lower_end, ProfileEnd::kFound);
  EXPECT_FALSE(far.found_better);
}

// 5 + (exp(x) - 1)^2 reaches 6.25 at ln(1 - sqrt(1.25)) and ln(1 + sqrt(1.25)), but the first value
// does not exist.
TEST(Profile, FindsSkewedIntervalsAndOpenEnds) {
  const ProfiledCost cost = [](double x) { return 5.0 + std::pow(std::expm1(x), 2.0); };
  const ProfileInterval open = profile_interval(at(0.0, 1.25, 1.0), cost);
  EXPECT_NEAR(open.upper, std::log1p(std::sqrt(1.25)), 2e-4);
  EXPECT_EQ(open.lower_end, ProfileEnd::kUnbounded);
  EXPECT_LE(open.lower, -1000.0);
  const ProfileInterval skewed = profile_interval(at(0.0, 0.81, 1.0), cost);
  EXPECT_NEAR(skewed.lower, std::log(0.1), 1e-3);
  EXPECT_NEAR(skewed.upper, std::log(1.9), 2e-4);
}

TEST(Profile, EndsAtBounds) {
  const ProfiledCost cost = [](double x) {
    EXPECT_GE(x, 1.8);
    return 5.0 + 4.0 * (x - 2.0) * (x - 2.0);
  };
  ProfileProblem problem = at(2.0, 1.0, 0.5);
  problem.lower = 1.8;
  const ProfileInterval bounded = profile_interval(problem, cost);
  EXPECT_EQ(bounded.lower, 1.8);
  EXPECT_EQ(bounded.lower_end, ProfileEnd::kBound);
  EXPECT_NEAR(bounded.upper, 2.5, 1e-4);
  problem.optimum = problem.lower = 2.0;
  EXPECT_EQ(profile_interval(problem, cost).lower, 2.0);
  EXPECT_EQ(profile_interval(problem, cost).lower_end, ProfileEnd::kBound);
}

TEST(Profile, TellsFitsThatFailAndFitsThatAreBetter) {
  const ProfiledCost fails = [](double x) -> std::optional<double> {
    if (x > 2.3) return std::nullopt;
    return 5.0 + 4.0 * (x - 2.0) * (x - 2.0);
  };
  const ProfileInterval failed = profile_interval(at(2.0, 1.0, 0.2), fails);
  EXPECT_EQ(failed.upper_end, ProfileEnd::kFailed);
  EXPECT_NEAR(failed.upper, 2.2, 1e-12);
  EXPECT_NEAR(failed.lower, 1.5, 1e-4);
  const ProfiledCost better = [](double x) { return 5.0 + 4.0 * (x - 2.2) * (x - 2.2) - 0.16; };
  EXPECT_TRUE(profile_interval(at(2.0, 1.0, 0.2), better).found_better);
}

TEST(Profile, TheThresholdGivesTheLinearIntervalOfALinearFit) {
  // Sum of squares = cost + (x - x0)^2 / v with the variance s^2 v of x: at the end, (x - x0)^2 =
  // factor^2 s^2 v.
  const double variance = 0.3, v = 0.01, factor = interval_factor(0.9, 12.0);
  EXPECT_NEAR(profile_threshold(0.9, variance, 1.0, 12.0), factor * factor * variance * v / v,
              1e-14);
  EXPECT_NEAR(profile_threshold(0.9, variance, 4.0, 12.0),
              4.0 * profile_threshold(0.9, variance, 1.0, 12.0), 1e-13);
}

}  // namespace
}  // namespace codesign
