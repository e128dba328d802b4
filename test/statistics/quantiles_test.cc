// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/quantiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace codesign {
namespace {

constexpr double kMany = std::numeric_limits<double>::infinity();

// The closed forms for 1, 2 and 4 degrees of freedom (W. T. Shaw, J. Comput. Finance 9(4), 2006).
double of_one(double p) { return std::tan(3.14159265358979323846 * (p - 0.5)); }
double of_two(double p) { return (2.0 * p - 1.0) / std::sqrt(2.0 * p * (1.0 - p)); }
double of_four(double p) {
  const double root = std::sqrt(4.0 * p * (1.0 - p));
  return std::copysign(2.0 * std::sqrt(std::cos(std::acos(root) / 3.0) / root - 1.0), p - 0.5);
}

TEST(Quantiles, OfStudentAreTheClosedForms) {
  for (const double p : {0.001, 0.2, 0.4999, 0.6, 0.975, 0.9995}) {
    EXPECT_NEAR(student_quantile(p, 1.0) / of_one(p), 1.0, 2e-12) << p;
    EXPECT_NEAR(student_quantile(p, 2.0) / of_two(p), 1.0, 2e-12) << p;
    EXPECT_NEAR(student_quantile(p, 4.0) / of_four(p), 1.0, 2e-12) << p;
  }
  EXPECT_EQ(student_quantile(0.5, 7.0), 0.0);
}

// R: qt(0.975, 5), qnorm(0.975).
TEST(Quantiles, TendToThoseOfTheNormalDistribution) {
  EXPECT_NEAR(student_quantile(0.975, 5.0), 2.570581835636314, 1e-12);
  EXPECT_NEAR(student_quantile(0.975, kMany), 1.959963984540054, 1e-14);
  EXPECT_NEAR(student_quantile(0.975, 9.9e7), 1.959963984540054, 1e-7);
  EXPECT_GT(student_quantile(0.975, 30.5), student_quantile(0.975, 31.0));
}

TEST(Quantiles, AnIntervalLeavesHalfOfTheRestOnEachSide) {
  EXPECT_NEAR(interval_factor(0.95, 5.0), student_quantile(0.975, 5.0), 1e-13);
  EXPECT_NEAR(interval_factor(0.6826894921370859, kMany), 1.0, 1e-14);
}

// scipy 1.10.1: chi2.sf.
TEST(Quantiles, TailsOfChiSquared) {
  EXPECT_NEAR(chi_squared_tail(18.3, 10.0), 0.050109061411462506, 1e-15);
  EXPECT_NEAR(chi_squared_tail(200.0, 3.0) / 4.218541107192018e-43, 1.0, 1e-12);
  EXPECT_EQ(chi_squared_tail(0.0, 4.0), 1.0);
}

}  // namespace
}  // namespace codesign
