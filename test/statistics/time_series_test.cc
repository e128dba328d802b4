// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "statistics/time_series.h"

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
          sum += (1.0 - static_cast<double>(std::abs(t - s)) / (lag + 1.0)) *
                 x.row(begin + t).transpose() * x.row(begin + s);
    begin += length;
  }
  return sum;
}

TEST(BartlettSum, IsTheDefinition) {
  const Eigen::MatrixXd x = noise(60, 3, 0.5, 1);
  for (const int lag : {1, 4, 30, 80}) {
    EXPECT_LT((bartlett_sum(x, {60}, lag) - by_definition(x, {60}, lag)).norm(), 1e-10) << lag;
    EXPECT_LT((bartlett_sum(x, {25, 35}, lag) - by_definition(x, {25, 35}, lag)).norm(), 1e-10)
        << lag;
  }
}

TEST(SumsOver, PartsOfEachSeries) {
  Eigen::MatrixXd x(7, 1);
  x << 1.0, 2.0, 3.0, 4.0, 10.0, 20.0, 30.0;
  const SeriesLengths parts = equal_parts({4, 3}, 2);
  EXPECT_EQ(parts, (SeriesLengths{2, 2, 2, 1}));
  const SummedSeries sums = sums_over(x, {4, 3}, parts);
  EXPECT_EQ(sums.lengths, (SeriesLengths{2, 2}));
  EXPECT_EQ(sums.terms, Eigen::Vector4d(3.0, 7.0, 30.0, 30.0));
}

TEST(LongRun, OfWhiteNoiseIsTheSumOfSquares) {
  const Eigen::MatrixXd x = noise(20000, 1, 0.0, 2);
  const LongRunCovariance result = long_run_covariance(x, {20000});
  EXPECT_NEAR(result.covariance(0, 0) / 20000.0, 1.0, 0.15);
  EXPECT_EQ(result.lag, 183);
}

// The sum of N terms of an autoregression has the variance N / (1 - rho)^2.
TEST(LongRun, OfAnAutoregressionIsItsSpectrumAtZero) {
  const double rho = 0.9;
  double mean = 0.0;
  constexpr int kRuns = 20;
  for (unsigned seed = 0; seed < kRuns; ++seed)
    mean +=
        long_run_covariance(noise(4000, 1, rho, seed), {4000}).covariance(0, 0) / 4000.0 / kRuns;
  EXPECT_NEAR(mean * (1.0 - rho) * (1.0 - rho), 1.0, 0.1);
}

/// Noise behind a filter is smoother than an autoregression of order one, which alone would
/// estimate 1.74 times the variance N / (1 - 1.4 + 0.6)^2; one of order two is right.
TEST(LongRun, OfFilteredNoiseLiesBetweenBothOrders) {
  constexpr Eigen::Index kRows = 1000, kBefore = 300;
  constexpr int kRuns = 40;
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  double mean = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(kBefore + kRows, 1);
    for (Eigen::Index t = 2; t < x.rows(); ++t)
      x(t, 0) = 1.4 * x(t - 1, 0) - 0.6 * x(t - 2, 0) + normal(generator);
    mean += long_run_covariance(x.bottomRows(kRows), {kRows}).covariance(0, 0) / kRows / kRuns;
  }
  EXPECT_NEAR(mean * 0.04, 0.5 * (1.0 + 1.74), 0.15);
}

TEST(LongRun, ShortSeriesHaveNoTermsOfTheirNeighbours) {
  Eigen::MatrixXd x(5, 1);
  x << 1.0, -1.0, 2.0, 0.5, -0.25;
  const double sum = long_run_covariance(x, {1, 2, 1, 1}, 1).covariance(0, 0);
  EXPECT_TRUE(std::isfinite(sum));
  EXPECT_GT(sum, 0.0);
}

TEST(LongRun, SeriesAreIndependentOfEachOther) {
  Eigen::MatrixXd x = noise(2000, 1, 0.9, 3);
  // The second recording repeats the first: taken as one, they would correlate only at lags beyond
  // the kernel's.
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

/// Terms that change slowly: 5 and 7 turns in 1000 rows.
Eigen::MatrixXd slow_terms() {
  return Eigen::MatrixXd::NullaryExpr(1000, 2, [](Eigen::Index t, Eigen::Index k) {
    return std::sin(0.00628 * static_cast<double>((2 * k + 5) * t)) +
           0.5 * std::cos(3.0 * static_cast<double>(t * t + k));
  });
}

// The variance of a sum of blocks tends to the kernel's estimate of the same width; blocks at the
// ends make the difference.
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
  EXPECT_EQ(bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3),
            bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3));
  EXPECT_NE(bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 3),
            bootstrap_sums(slow_terms(), {400, 600}, 20, 10, 4));
}

TEST(BlockBootstrap, ABlockIsAtMostAQuarterOfItsSeries) {
  const Eigen::MatrixXd draws = bootstrap_sums(slow_terms(), {1000}, 5000, 10, 1);
  EXPECT_EQ(draws, bootstrap_sums(slow_terms(), {1000}, 250, 10, 1));
  EXPECT_GT(draws.norm(), 1.0);
  EXPECT_EQ(block_within({400, 600}, 5000), 150);
  EXPECT_EQ(block_within({400, 600}, 20), 20);
  EXPECT_EQ(block_within({3, 2}, 20), 1);
}

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

Eigen::VectorXd series(double (*f)(double)) {
  return Eigen::VectorXd::NullaryExpr(100,
                                      [f](Eigen::Index k) { return f(static_cast<double>(k)); });
}
double wave(double k) { return std::sin(0.7 * k) + std::fmod(k * k, 7.0) / 5.0; }
double chirp(double k) { return std::cos(3.0 * k * k + 0.5 * k); }

// statsmodels 0.13.5: acorr_ljungbox(x, lags=[1, 3, 10]).
TEST(LjungBox, GivesTheNumbersOfStatsmodels) {
  const Whiteness one = ljung_box(series(wave), {100}, 1),
                  three = ljung_box(series(wave), {100}, 3), ten = ljung_box(series(wave), {100});
  EXPECT_NEAR(one.statistic, 44.43457848900372, 1e-10);
  EXPECT_NEAR(one.probability / 2.630005432752963e-11, 1.0, 1e-9);
  EXPECT_NEAR(three.statistic, 62.452746721158036, 1e-10);
  EXPECT_EQ(ten.lags, 10);
  EXPECT_NEAR(ten.statistic, 361.61057587693165, 1e-9);
  EXPECT_NEAR(ten.probability / 1.3663292357336851e-71, 1.0, 1e-9);
  const Whiteness white = ljung_box(series(chirp), {100}, 10);
  EXPECT_NEAR(white.statistic, 5.641563445827559, 1e-9);
  EXPECT_NEAR(white.probability, 0.8444252034225589, 1e-11);
}

TEST(LjungBox, RecordingsHaveTheirOwnMeans) {
  Eigen::VectorXd two(200);
  two << series(chirp), series(chirp).array() + 100.0;
  EXPECT_GT(ljung_box(two, {100, 100}).probability, 0.1);
  EXPECT_LT(ljung_box(two, {200}).probability, 1e-10);
  EXPECT_GT(ljung_box(two, {200}).first_correlation, 0.9);
}

TEST(LjungBox, ZerosAreWhite) {
  EXPECT_EQ(ljung_box(Eigen::VectorXd::Zero(50), {50}).probability, 1.0);
}

}  // namespace

}  // namespace codesign
