// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/block_bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

/// Terms that change slowly: 5 and 7 turns in 1000 rows.
Eigen::MatrixXd slow_terms() {
  return Eigen::MatrixXd::NullaryExpr(1000, 2, [](Eigen::Index t, Eigen::Index k) {
    return std::sin(0.00628 * static_cast<double>((2 * k + 5) * t)) + 0.5 * std::cos(3.0 * static_cast<double>(t * t + k));
  });
}

// The variance of a sum of blocks tends to the kernel's estimate of the same width; blocks at the ends make the difference.
TEST(BlockBootstrap, AgreesWithTheKernel) {
  const Eigen::MatrixXd terms = slow_terms();
  const Eigen::MatrixXd draws = bootstrap_sums(terms, {1000}, 20, 4000, 1);
  ASSERT_EQ(draws.rows(), 4000);
  EXPECT_LT(draws.colwise().mean().norm(), 1e-9);
  const Eigen::MatrixXd covariance = draws.transpose() * draws / 3999.0;
  const Eigen::MatrixXd kernel = bartlett_sum(terms, {1000}, 19);
  EXPECT_NEAR(covariance(0, 0) / kernel(0, 0), 1.0, 0.1);
  EXPECT_NEAR(covariance(1, 1) / kernel(1, 1), 1.0, 0.1);
}

TEST(BlockBootstrap, RepeatsItselfForOneSeed) {
  EXPECT_EQ(bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3), bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3));
  EXPECT_NE(bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3), bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 4));
}

TEST(BlockBootstrap, ASeriesOfOneBlockNeverVaries) { EXPECT_LT(bootstrap_sums(slow_terms(), {1000}, 5000, 10, 1).norm(), 1e-9); }

// Blocks that end at the end of the first series do not reach into the second.
TEST(BlockBootstrap, BlocksStayInTheirSeries) {
  Eigen::MatrixXd terms = Eigen::MatrixXd::Zero(100, 1);
  terms.bottomRows(50).setOnes();
  EXPECT_LT(bootstrap_sums(terms, {50, 50}, 7, 50, 1).norm(), 1e-9);
  EXPECT_GT(bootstrap_sums(terms, {100}, 7, 50, 1).norm(), 1.0);
}

TEST(EmpiricalQuantile, InterpolatesBetweenEntries) {
  const Eigen::Vector4d values(3.0, 1.0, 4.0, 2.0);
  EXPECT_EQ(empirical_quantile(values, 0.0), 1.0);
  EXPECT_EQ(empirical_quantile(values, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(empirical_quantile(values, 0.5), 2.5);
}

}  // namespace
}  // namespace codesign
