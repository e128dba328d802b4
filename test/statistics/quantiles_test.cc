// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/quantiles.h"

#include <gtest/gtest.h>

#include <limits>

namespace codesign {
namespace {

constexpr double kMany = std::numeric_limits<double>::infinity();

// scipy 1.10.1: t.ppf, norm.ppf, chi2.sf.
TEST(Quantiles, AreThoseOfStudentAndGauss) {
  EXPECT_NEAR(student_quantile(0.975, 5.0), 2.5705818366147395, 1e-13);
  EXPECT_NEAR(student_quantile(0.975, 1.0), 12.706204736432095, 1e-12);
  EXPECT_NEAR(student_quantile(0.9, 30.5), 1.3099313134320165, 1e-13);
  EXPECT_NEAR(student_quantile(0.9995, 2.5), 18.27789352778505, 1e-11);
  EXPECT_NEAR(student_quantile(0.02, 7.0), -2.5167524227227362, 1e-13);
  EXPECT_EQ(student_quantile(0.5, 7.0), 0.0);
  EXPECT_NEAR(student_quantile(0.975, kMany), 1.959963984540054, 1e-14);
  EXPECT_NEAR(student_quantile(0.975, 9.9e7), 1.959963984540054, 1e-7);
}

TEST(Quantiles, AnIntervalLeavesHalfOfTheRestOnEachSide) {
  EXPECT_NEAR(interval_factor(0.95, 5.0), student_quantile(0.975, 5.0), 1e-13);
  EXPECT_NEAR(interval_factor(0.6826894921370859, kMany), 1.0, 1e-14);
}

TEST(Quantiles, TailsOfChiSquared) {
  EXPECT_NEAR(chi_squared_tail(18.3, 10.0), 0.050109061411462506, 1e-15);
  EXPECT_NEAR(chi_squared_tail(200.0, 3.0) / 4.218541107192018e-43, 1.0, 1e-12);
  EXPECT_EQ(chi_squared_tail(0.0, 4.0), 1.0);
}

}  // namespace
}  // namespace codesign
