// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "math/arrays.h"
#include "math/dense.h"
#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

IntervalOptions options_of(NoiseModel noise, int lag = 0, double level = 0.95) {
  IntervalOptions options;
  options.noise = noise;
  options.lag = lag;
  options.level = level;
  return options;
}

/// A linear fit: columns 1, cos(0.05 k), k / 100 over 100 rows, the input for statsmodels.
struct LinearFit {
  Eigen::MatrixXd X = Eigen::MatrixXd(100, 3);
  Eigen::VectorXd residuals;

  LinearFit() {
    Eigen::VectorXd y(100);
    for (Eigen::Index i = 0; i < 100; ++i) {
      const auto k = static_cast<double>(i);
      X.row(i) << 1.0, std::cos(0.05 * k), k / 100.0;
      y[i] = X.row(i).dot(Eigen::Vector3d(1.0, 2.0, 3.0)) + std::sin(0.3 * k) +
             0.2 * (std::fmod(k * k, 7.0) - 3.0);
    }
    residuals = y - X * least_norm(X).solve(y);
  }
};

// statsmodels 0.13.5: OLS(y, X).fit().cov_params().
TEST(ParameterCovariance, WhiteNoiseGivesTheCovarianceOfOrdinaryLeastSquares) {
  const LinearFit fit;
  const ParameterCovariance white =
      parameter_covariance(fit.residuals, fit.X, {100}, options_of(NoiseModel::kWhite));
  EXPECT_NEAR(white.covariance(0, 0), 0.031968533391019884, 1e-14);
  EXPECT_NEAR(white.covariance(0, 1), -0.014272580808639405, 1e-14);
  EXPECT_NEAR(white.covariance(2, 2), 0.131379241180395, 1e-14);
  EXPECT_EQ(white.degrees, Eigen::Vector3d::Constant(97.0));
  EXPECT_EQ(white.lag, 0);
  EXPECT_NEAR(white.above[2], student_quantile(0.975, 97.0) * std::sqrt(0.131379241180395), 1e-12);
  EXPECT_EQ(white.above, white.below);
  EXPECT_NEAR(white.correlation()(0, 1),
              -0.014272580808639405 / std::sqrt(0.031968533391019884 * 0.024766585931535075),
              1e-12);
  EXPECT_EQ(white.correlation()(1, 1), 1.0);
}

// statsmodels 0.13.5: get_robustcov_results('HAC', maxlags=5, use_correction=False), whose kernel
// works on the scores as they are.
TEST(ParameterCovariance, TheKernelOfTheScoresIsThatOfStatsmodels) {
  const LinearFit fit;
  const Eigen::MatrixXd inverse =
      least_norm(fit.X.transpose() * fit.X).solve(Eigen::MatrixXd::Identity(3, 3));
  const Eigen::MatrixXd terms = fit.residuals.asDiagonal() * fit.X * inverse;
  const Eigen::MatrixXd covariance = bartlett_sum(terms, {100}, 5);
  EXPECT_NEAR(covariance(0, 0), 0.11539627615412597, 1e-12);
  EXPECT_NEAR(covariance(0, 2), -0.20773399012268192, 1e-12);
  EXPECT_NEAR(covariance(2, 2), 0.47161190334442027, 1e-12);
}

TEST(ParameterCovariance, ResidualsThatDoNotCountLeaveTheirVariance) {
  const LinearFit fit;
  EliminatedUnknowns eliminated;
  eliminated.counted.setOnes(100, 1);
  eliminated.counted.topRows(20).setZero();
  for (const double beyond : {0.0, 50.0}) {
    Eigen::MatrixXd residuals = fit.residuals;
    residuals.topRows(20).setConstant(beyond);
    const ParameterCovariance known =
        parameter_covariance(residuals, fit.X, {100}, options_of(NoiseModel::kWhite), eliminated);
    EXPECT_NEAR(known.residual_variance, fit.residuals.tail(80).squaredNorm() / 77.0, 1e-12);
    EXPECT_EQ(known.degrees[0], 77.0);
  }
}

TEST(ParameterCovariance, OutputsAtOneTimeDependOnEachOther) {
  const LinearFit fit;
  // The same output twice has no more information, though white noise would promise half of the
  // variance.
  Eigen::MatrixXd residuals(100, 2), jacobian(200, 3);
  residuals << fit.residuals, fit.residuals;
  jacobian << fit.X, fit.X;
  const IntervalOptions options = options_of(NoiseModel::kCorrelated, 5);
  const ParameterCovariance once = parameter_covariance(fit.residuals, fit.X, {100}, options);
  const ParameterCovariance twice = parameter_covariance(residuals, jacobian, {100}, options);
  EXPECT_NEAR(twice.covariance(2, 2) / once.covariance(2, 2), 1.0, 1e-9);
  const IntervalOptions white = options_of(NoiseModel::kWhite);
  EXPECT_NEAR(parameter_covariance(residuals, jacobian, {100}, white).covariance(2, 2) /
                  parameter_covariance(fit.residuals, fit.X, {100}, white).covariance(2, 2),
              97.0 / 197.0, 1e-9);
}

TEST(ParameterCovariance, WhatTheDataDoNotTellHasNoInterval) {
  const LinearFit fit;
  Eigen::MatrixXd jacobian(100, 4);
  jacobian << fit.X, 3.0 * fit.X.col(1);
  for (const NoiseModel noise :
       {NoiseModel::kWhite, NoiseModel::kCorrelated, NoiseModel::kBootstrap}) {
    const ParameterCovariance result = parameter_covariance(
        fit.residuals, jacobian, {100}, options_of(noise, noise == NoiseModel::kWhite ? 0 : 5));
    const ParameterCovariance told = parameter_covariance(
        fit.residuals, fit.X, {100}, options_of(noise, noise == NoiseModel::kWhite ? 0 : 5));
    EXPECT_EQ(result.identifiability.rank, 3);
    EXPECT_TRUE(std::isinf(result.above[1]) && std::isinf(result.below[3]) &&
                std::isinf(result.covariance(3, 3)));
    EXPECT_TRUE(std::isnan(result.covariance(0, 1)) && std::isnan(result.correlation()(3, 1)));
    EXPECT_NEAR(result.covariance(0, 2) / told.covariance(0, 2), 1.0, 1e-8);
    EXPECT_NEAR(result.above[2] / told.above[2], 1.0, 1e-8);
  }
}

/// How often intervals at 95 % hold the truth, in 200 runs of a linear model with noise u_t = rho
/// u_{t-1} + e_t: per parameter.
std::array<int, 3> count_covered(NoiseModel noise, double rho, Eigen::Index count) {
  const Eigen::Vector3d truth(1.0, 2.0, 3.0);
  Eigen::MatrixXd X(count, 3);
  for (Eigen::Index t = 0; t < count; ++t) {
    const double part = 6.283185307179586 * static_cast<double>(t) / static_cast<double>(count);
    X.row(t) << std::sin(5.0 * part), std::sin(7.0 * part) > 0.0 ? 1.0 : -1.0, 1.0;
  }
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  const LeastNorm fit = least_norm(X);
  std::array<int, 3> covered{};
  for (int run = 0; run < 200; ++run) {
    Eigen::VectorXd y = X * truth;
    double u = normal(generator) / std::sqrt(1.0 - rho * rho);
    for (double& value : y) {
      value += u;
      u = rho * u + normal(generator);
    }
    const Eigen::VectorXd x = fit.solve(y);
    const ParameterCovariance known =
        parameter_covariance(y - X * x, X, {count}, options_of(noise));
    for (Eigen::Index k = 0; k < 3; ++k)
      if (x[k] - known.below[k] <= truth[k] && truth[k] <= x[k] + known.above[k])
        ++covered[static_cast<std::size_t>(k)];
  }
  return covered;
}

TEST(Coverage, OfCorrelatedNoiseHolds) {
  for (const double rho : {0.0, 0.5, 0.8}) {
    for (const int covered : count_covered(NoiseModel::kCorrelated, rho, 2000)) {
      EXPECT_GE(covered, 184) << rho;
      EXPECT_LE(covered, 198) << rho;
    }
  }
}

TEST(Coverage, OfWhiteNoiseFailsWhereNoiseIsCorrelated) {
  for (const int covered : count_covered(NoiseModel::kWhite, 0.8, 2000)) EXPECT_LE(covered, 130);
  for (const int covered : count_covered(NoiseModel::kWhite, 0.0, 500)) EXPECT_GE(covered, 182);
}

TEST(Coverage, OfTheBootstrapIsNearlyTheKernels) {
  for (const int covered : count_covered(NoiseModel::kBootstrap, 0.8, 1000))
    EXPECT_GE(covered, 170);
}

// Noise of a time constant of a 40th of the recording, at a high rate.
TEST(Coverage, DoesNotDependOnTheRate) {
  for (const Eigen::Index count : {1000, 10000}) {
    const double rho = std::exp(-40.0 / static_cast<double>(count));
    for (const int covered : count_covered(NoiseModel::kCorrelated, rho, count))
      EXPECT_GE(covered, 172) << count;
    for (const int covered : count_covered(NoiseModel::kBootstrap, rho, count))
      EXPECT_GE(covered, 160) << count;
  }
}

TEST(ParameterCovariance, AGivenLagCountsTimes) {
  const Eigen::MatrixXd X = Eigen::MatrixXd::Ones(2000, 1);
  Eigen::VectorXd residuals(2000);
  for (Eigen::Index k = 0; k < 2000; ++k) residuals[k] = k % 2 == 0 ? 1.0 : -1.0;
  EXPECT_EQ(parameter_covariance(residuals, X, {2000}, options_of(NoiseModel::kBootstrap, 7)).lag,
            7);
  const ParameterCovariance automatic =
      parameter_covariance(residuals, X, {2000}, options_of(NoiseModel::kBootstrap));
  EXPECT_EQ(automatic.lag % 4, 0) << "sums over four times";
}

/// A given lag leaves the moments nearly those of the same lag in sums.
TEST(ParameterCovariance, AGivenLagHasTheMomentsOfSums) {
  constexpr Eigen::Index kCount = 4000;
  const Eigen::MatrixXd X = Eigen::MatrixXd::Ones(kCount, 1);
  Eigen::VectorXd residuals(kCount);
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (double& value : residuals) value = normal(generator);
  residuals.array() -= residuals.mean();
  for (const NoiseModel noise : {NoiseModel::kCorrelated, NoiseModel::kBootstrap}) {
    const ParameterCovariance known =
        parameter_covariance(residuals, X, {kCount}, options_of(noise, 200));
    EXPECT_EQ(known.lag, 200);
    EXPECT_NEAR(known.degrees[0] * 200.0 / kCount, 1.5, 0.1);
  }
}

/// Many recordings, each shorter than the block asked for, or of one time: without noise that is
/// correlated, the deviation is nearly that of white noise.
TEST(ParameterCovariance, BlocksFitIntoShortRecordings) {
  constexpr Eigen::Index kCount = 400;
  const Eigen::MatrixXd X = Eigen::MatrixXd::Ones(kCount, 1);
  Eigen::VectorXd residuals(kCount);
  std::mt19937 generator(6);
  std::normal_distribution<double> normal;
  for (double& value : residuals) value = normal(generator);
  residuals.array() -= residuals.mean();
  const double white =
      parameter_covariance(residuals, X, {kCount}, options_of(NoiseModel::kWhite)).covariance(0, 0);
  for (const Eigen::Index length : {1, 2, 10, 40}) {
    const ParameterCovariance known =
        parameter_covariance(residuals, X, SeriesLengths(to_index(kCount / length), length),
                             options_of(NoiseModel::kBootstrap, 50));
    EXPECT_EQ(known.lag, std::max<Eigen::Index>(1, length / 4));
    EXPECT_NEAR(std::sqrt(known.covariance(0, 0) / white), 1.0, 0.25) << length;
    EXPECT_GT(known.above[0], 1.5 * std::sqrt(white)) << length;
  }
}

/// How often intervals at 95 % hold the truth, in 200 runs of white noise in which each piece of
/// 50 times has an offset and a slope of its own: per parameter. @param unequal standard deviation
/// of the logarithms of how much a piece tells of a parameter
std::array<int, 3> count_covered_with_pieces(Eigen::Index pieces, double unequal = 0.0) {
  constexpr Eigen::Index kLength = 50;
  const Eigen::Index count = kLength * pieces;
  Eigen::MatrixXd X(count, 3), own(kLength, 2);
  for (Eigen::Index k = 0; k < kLength; ++k) own.row(k) << 1.0, static_cast<double>(k);
  const Eigen::MatrixXd without =
      Eigen::MatrixXd::Identity(kLength, kLength) -
      own * least_norm(own).solve(Eigen::MatrixXd::Identity(kLength, kLength));
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = 0.02 * static_cast<double>(k);
    X.row(k) << std::sin(2.1 * t + 0.3), std::cos(3.1 * t), std::cos(4.4 * t);
  }
  for (Eigen::Index k = 0; k < pieces; ++k)
    X.middleRows(k * kLength, kLength) = without * X.middleRows(k * kLength, kLength).eval();
  std::mt19937 of_pieces(5);
  std::normal_distribution<double> logarithm(0.0, 1.0);
  for (Eigen::Index k = 0; k < pieces; ++k)
    for (Eigen::Index column = 0; column < 3; ++column)
      X.col(column).segment(k * kLength, kLength) *= std::exp(unequal * logarithm(of_pieces));
  EliminatedUnknowns eliminated{2 * pieces,
                                SeriesLengths(static_cast<std::size_t>(pieces), kLength)};
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  const LeastNorm fit = least_norm(X);
  std::array<int, 3> covered{};
  for (int run = 0; run < 200; ++run) {
    Eigen::VectorXd y(count);
    for (double& value : y) value = normal(generator);
    const Eigen::VectorXd x = fit.solve(y);
    for (Eigen::Index k = 0; k < pieces; ++k)
      y.segment(k * kLength, kLength) = without * y.segment(k * kLength, kLength).eval();
    const ParameterCovariance known = parameter_covariance(
        y - X * x, X, {count}, options_of(NoiseModel::kCorrelated), eliminated);
    for (Eigen::Index k = 0; k < 3; ++k)
      if (std::abs(x[k]) <= known.above[k]) ++covered[static_cast<std::size_t>(k)];
  }
  return covered;
}

TEST(Coverage, HoldsWherePiecesHaveUnknownsOfTheirOwn) {
  for (const Eigen::Index pieces : {10, 40})
    for (const int covered : count_covered_with_pieces(pieces)) {
      EXPECT_GE(covered, 182) << pieces;
      EXPECT_LE(covered, 199) << pieces;
    }
}

/// Pieces that tell much draw the fit, so that their residuals are too small: without that counted
/// 89 % are held.
TEST(Coverage, HoldsWhereSomePiecesTellMuchMoreThanOthers) {
  const std::array<int, 3> covered = count_covered_with_pieces(10, 1.0);
  const int all = covered[0] + covered[1] + covered[2];
  RecordProperty("covered", all);
  EXPECT_GE(all, 552);
  EXPECT_LE(all, 590);
}

TEST(ParameterCovariance, ThePredictionIsThatOfResidualsOfVarianceOne) {
  const LinearFit fit;
  const double variance = fit.residuals.squaredNorm() / 97.0;
  const ParameterCovariance white =
      parameter_covariance(fit.residuals, fit.X, {100}, options_of(NoiseModel::kWhite, 0, 0.9));
  const ParameterCovariance predicted = predicted_covariance(fit.X / std::sqrt(variance), 100, 0.9);
  EXPECT_TRUE(predicted.covariance.isApprox(white.covariance, 1e-12));
  EXPECT_TRUE(predicted.above.isApprox(white.above, 1e-12));
  const ParameterCovariance by_factor =
      predicted_covariance(upper_factor(fit.X / std::sqrt(variance)), 100, 0.9);
  EXPECT_TRUE(by_factor.above.isApprox(white.above, 1e-12));
  Eigen::MatrixXd dependent = fit.X;
  dependent.col(2) = 3.0 * dependent.col(0);
  EXPECT_TRUE(std::isinf(predicted_covariance(dependent, 100, 0.9).above[2]));
  EXPECT_TRUE(std::isfinite(predicted_covariance(dependent, 100, 0.9).above[1]));
}

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
