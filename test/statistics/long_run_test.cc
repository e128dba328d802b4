// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/long_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace codesign {
namespace {

Eigen::MatrixXd noise(Eigen::Index rows, Eigen::Index columns, double correlation, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd result(rows, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    double value = normal(generator) / std::sqrt(1.0 - correlation * correlation);
    for (Eigen::Index t = 0; t < rows; ++t) {
      result(t, k) = value;
      value = correlation * value + normal(generator);
    }
  }
  return result;
}

/// The definition, term by term.
Eigen::MatrixXd by_definition(const Eigen::MatrixXd& x, const SeriesLengths& lengths, int lag) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(x.cols(), x.cols());
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    for (Eigen::Index t = 0; t < length; ++t)
      for (Eigen::Index s = 0; s < length; ++s)
        if (std::abs(t - s) <= lag)
          sum += (1.0 - static_cast<double>(std::abs(t - s)) / (lag + 1.0)) * x.row(begin + t).transpose() * x.row(begin + s);
    begin += length;
  }
  return sum;
}

TEST(BartlettSum, IsTheDefinition) {
  const Eigen::MatrixXd x = noise(60, 3, 0.5, 1);
  for (const int lag : {1, 4, 30, 80}) {
    EXPECT_LT((bartlett_sum(x, {60}, lag) - by_definition(x, {60}, lag)).norm(), 1e-10) << lag;
    EXPECT_LT((bartlett_sum(x, {25, 35}, lag) - by_definition(x, {25, 35}, lag)).norm(), 1e-10) << lag;
  }
}

TEST(LongRun, OfWhiteNoiseIsTheSumOfSquares) {
  const Eigen::MatrixXd x = noise(20000, 1, 0.0, 2);
  const LongRunCovariance result = long_run_covariance(x, {20000});
  EXPECT_NEAR(result.covariance(0, 0) / 20000.0, 1.0, 0.15);
  EXPECT_EQ(result.lag, 183);
  EXPECT_NEAR(result.degrees, 1.5 * 20000.0 / 184.0, 1e-9);
}

// The sum of N terms of an autoregression has the variance N / (1 - rho)^2.
TEST(LongRun, OfAnAutoregressionIsItsSpectrumAtZero) {
  const double rho = 0.9;
  double mean = 0.0;
  constexpr int kRuns = 20;
  for (unsigned seed = 0; seed < kRuns; ++seed)
    mean += long_run_covariance(noise(4000, 1, rho, seed), {4000}).covariance(0, 0) / 4000.0 / kRuns;
  EXPECT_NEAR(mean * (1.0 - rho) * (1.0 - rho), 1.0, 0.1);
}

TEST(LongRun, SeriesAreIndependentOfEachOther) {
  Eigen::MatrixXd x = noise(2000, 1, 0.9, 3);
  // The second recording repeats the first: taken as one, they would correlate only at lags beyond the kernel's.
  x.bottomRows(1000) = x.topRows(1000);
  const double one = long_run_covariance(x.topRows(1000), {1000}, 50).covariance(0, 0);
  const double two = long_run_covariance(x, {1000, 1000}, 50).covariance(0, 0);
  EXPECT_NEAR(two / one, 2.0, 0.06);
}

TEST(LongRun, TheLagFollowsTheCorrelation) {
  EXPECT_EQ(automatic_lag(noise(2500, 2, 0.0, 4), {2500}), 65);
  EXPECT_GT(automatic_lag(noise(2500, 2, 0.97, 4), {2500}), 100);
  EXPECT_EQ(automatic_lag(noise(8, 1, 0.0, 4), {8}), 2);
}

TEST(LongRun, ZerosStayZeros) {
  const LongRunCovariance result = long_run_covariance(Eigen::MatrixXd::Zero(100, 2), {100});
  EXPECT_EQ(result.covariance, Eigen::MatrixXd::Zero(2, 2));
}

}  // namespace
}  // namespace codesign
