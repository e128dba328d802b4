// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statistics/kernel_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "math/dense.h"
#include "statistics/parameter_covariance.h"

namespace codesign {
namespace {

Eigen::MatrixXd kernel_of(const SeriesLengths& lengths, int lag) {
  Eigen::Index count = 0;
  for (const Eigen::Index length : lengths) count += length;
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(count, count);
  Eigen::Index begin = 0;
  for (const Eigen::Index length : lengths) {
    for (Eigen::Index i = 0; i < length; ++i)
      for (Eigen::Index j = 0; j < length; ++j)
        W(begin + i, begin + j) =
            std::max(0.0, 1.0 - static_cast<double>(std::abs(i - j)) / (lag + 1.0));
    begin += length;
  }
  return W;
}

TEST(BartlettProduct, IsTheProductWithTheWeights) {
  const Eigen::MatrixXd x = Eigen::MatrixXd::NullaryExpr(23, 2, [](Eigen::Index t, Eigen::Index k) {
    return std::sin(0.7 * static_cast<double>(t * t + 3 * k));
  });
  for (const SeriesLengths& lengths : {SeriesLengths{23}, SeriesLengths{9, 14}})
    for (const int lag : {0, 1, 5, 30})
      EXPECT_LT((bartlett_product(x, lengths, lag) - kernel_of(lengths, lag) * x).norm(), 1e-12)
          << lag;
}

/// A regression of two outputs whose second column tells much at few times.
struct Regression {
  static constexpr Eigen::Index kTimes = 60, kOutputs = 2;
  Eigen::MatrixXd J = Eigen::MatrixXd(kTimes * kOutputs, 3), Q, root;

  Regression() {
    for (Eigen::Index k = 0; k < J.rows(); ++k) {
      const auto t = static_cast<double>(k % kTimes);
      const double u = std::sin(0.3 * t + (k < kTimes ? 0.0 : 1.0));
      J.row(k) << 1.0, std::exp(-std::pow(4.0 * u, 2.0)), u;
    }
    root = least_norm(upper_factor(J)).solve(Eigen::MatrixXd::Identity(3, 3));
    Q = J * root;
  }
  /// The contributions of times to parameter k as a matrix on the noise.
  Eigen::MatrixXd on_noise(Eigen::Index k, const SeriesLengths& parts) const {
    const Eigen::VectorXd a = Q * root.row(k).transpose();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(parts.size()), J.rows());
    Eigen::Index begin = 0;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      for (Eigen::Index t = begin; t < begin + parts[part]; ++t)
        for (const Eigen::Index row : {t, kTimes + t})
          A(static_cast<Eigen::Index>(part), row) = a[row];
      begin += parts[part];
    }
    return A - (A * Q) * Q.transpose();
  }
};

/// Mean and variance of a quadratic form of normal numbers: tr(W C), 2 tr(W C W C).
TEST(KernelMoments, AreTheTracesOfTheQuadraticForm) {
  const Regression fit;
  ASSERT_LT((fit.Q.transpose() * fit.Q - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-10);
  const SeriesLengths ones(Regression::kTimes, 1), fives(12, 5);
  for (const auto& [parts, lengths] :
       {std::pair<SeriesLengths, SeriesLengths>{ones, {60}}, {ones, {25, 35}}, {fives, {5, 7}}})
    for (const int lag : {0, 3, 10}) {
      const KernelMoments moments =
          kernel_moments(fit.Q, Regression::kOutputs, parts, lengths, lag, {fit.root.transpose()});
      for (Eigen::Index k = 0; k < 3; ++k) {
        const Eigen::MatrixXd A = fit.on_noise(k, parts),
                              WC = kernel_of(lengths, lag) * A * A.transpose();
        EXPECT_NEAR(moments.means[k] / WC.trace(), 1.0, 1e-9);
        EXPECT_NEAR(moments.degrees[k] / (WC.trace() * WC.trace() / (WC * WC).trace()), 1.0, 1e-9);
      }
    }
}

/// Parts that are mapped each in its own way, as pieces of recordings are.
TEST(KernelMoments, TakeTheMapOfEachPart) {
  const Regression fit;
  const SeriesLengths fives(12, 5);
  std::vector<Eigen::MatrixXd> maps;
  for (int part = 0; part < 12; ++part)
    maps.push_back((1.0 + 0.1 * part) * fit.root.transpose() +
                   0.02 * part * Eigen::MatrixXd::Ones(3, 3));
  for (const int lag : {0, 3}) {
    const KernelMoments moments =
        kernel_moments(fit.Q, Regression::kOutputs, fives, {5, 7}, lag, maps);
    for (Eigen::Index k = 0; k < 3; ++k) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(12, fit.Q.rows());
      for (Eigen::Index row = 0; row < fit.Q.rows(); ++row) {
        const Eigen::Index part = row % Regression::kTimes / 5;
        A(part, row) = fit.Q.row(row).dot(maps[static_cast<std::size_t>(part)].col(k));
      }
      A -= A * fit.Q * fit.Q.transpose();
      const Eigen::MatrixXd WC = kernel_of({5, 7}, lag) * A * A.transpose();
      EXPECT_NEAR(moments.means[k] / WC.trace(), 1.0, 1e-9);
      EXPECT_NEAR(moments.degrees[k] / (WC.trace() * WC.trace() / (WC * WC).trace()), 1.0, 1e-9);
    }
  }
}

/// A window beyond a series is the whole series, however long.
TEST(KernelMoments, OfAnyLagTakeNoLonger) {
  constexpr int kLag = std::numeric_limits<int>::max();
  const Regression fit;
  const SeriesLengths lengths{25, 35};
  const KernelMoments moments = kernel_moments(fit.Q, Regression::kOutputs, SeriesLengths(60, 1),
                                               lengths, kLag, {fit.root.transpose()});
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::MatrixXd A = fit.on_noise(k, SeriesLengths(60, 1)),
                          WC = kernel_of(lengths, kLag) * A * A.transpose();
    EXPECT_NEAR(moments.means[k] / WC.trace(), 1.0, 1e-9);
    EXPECT_NEAR(moments.degrees[k] / (WC.trace() * WC.trace() / (WC * WC).trace()), 1.0, 1e-9);
  }
}

/// The only time that tells a parameter has no residual: white noise alone tells its variance.
TEST(KernelMoments, WithoutThemTheVarianceIsThatOfWhiteNoise) {
  Eigen::MatrixXd J(80, 2);
  Eigen::VectorXd noise(80);
  for (Eigen::Index k = 0; k < 80; ++k) {
    const auto t = static_cast<double>(k);
    J.row(k) << (k == 7 ? 3.0 : 0.0), (k == 7 ? 0.0 : std::sin(0.3 * t));
    noise[k] = std::sin(t * t);
  }
  const Eigen::VectorXd residuals = noise - J * least_norm(J).solve(noise);
  for (const NoiseModel model : {NoiseModel::kCorrelated, NoiseModel::kBootstrap}) {
    IntervalOptions options;
    options.noise = model;
    const ParameterCovariance known = parameter_covariance(residuals, J, {80}, options);
    const double variance = residuals.squaredNorm() / 78.0 / 9.0;
    EXPECT_NEAR(known.covariance(0, 0), variance, 1e-9);
    EXPECT_EQ(known.degrees[0], 1.0);
    EXPECT_NEAR(known.above[0], student_quantile(0.975, 1.0) * std::sqrt(variance), 1e-7);
    EXPECT_NEAR(known.below[0], known.above[0], 1e-7);
    EXPECT_GT(known.degrees[1], 5.0);
  }
}

/// A mean of white noise: lag 0 has N - 1 degrees of freedom, and the mean (N - 1)/N of the truth.
TEST(KernelMoments, OfAMeanAreThoseOfStudent) {
  constexpr Eigen::Index kCount = 40;
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Constant(kCount, 1, 1.0 / std::sqrt(40.0));
  const Eigen::MatrixXd map = Eigen::MatrixXd::Constant(1, 1, 1.0 / std::sqrt(40.0));
  const KernelMoments moments = kernel_moments(Q, 1, SeriesLengths(kCount, 1), {kCount}, 0, {map});
  EXPECT_NEAR(moments.means[0] * kCount, 39.0 / 40.0, 1e-12);
  EXPECT_NEAR(moments.degrees[0], 39.0, 1e-9);
}

/// As wide kernels of long series of one unknown: 1 - b + b^2/3 and about 1.5/b (Kiefer and
/// Vogelsang).
TEST(KernelMoments, TendToThoseOfFixedPartsOfTheSeries) {
  constexpr Eigen::Index kCount = 2000;
  constexpr int kLag = 99;
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Constant(kCount, 1, 1.0 / std::sqrt(2000.0));
  const KernelMoments moments =
      kernel_moments(Q, 1, SeriesLengths(kCount, 1), {kCount}, kLag,
                     {Eigen::MatrixXd::Constant(1, 1, 1.0 / std::sqrt(2000.0))});
  const double b = (kLag + 1.0) / static_cast<double>(kCount);
  EXPECT_NEAR(moments.means[0] * kCount, 1.0 - b + b * b / 3.0, 2e-4);
  EXPECT_NEAR(moments.degrees[0] * b, 1.5, 0.1);
}

TEST(KernelMoments, AParameterWithoutContributionsHasNoMean) {
  const Regression fit;
  Eigen::MatrixXd map = fit.root.transpose();
  map.col(1).setZero();
  const KernelMoments moments =
      kernel_moments(fit.Q, 2, SeriesLengths(Regression::kTimes, 1), {60}, 4, {map});
  EXPECT_EQ(moments.means[1], 0.0);
  EXPECT_EQ(moments.degrees[1], 1.0);
  EXPECT_GT(moments.means[0], 0.0);
}

/// The friction of a joint whose static part acts at few of 120 times.
Eigen::MatrixXd friction_columns() {
  Eigen::MatrixXd J(120, 4);
  for (Eigen::Index k = 0; k < J.rows(); ++k) {
    const double t = static_cast<double>(k) / 6.0;
    const double v = 0.8 * std::cos(0.9 * t) + 0.7 * std::cos(2.1 * t + 1.0);
    const double sign = std::tanh(v / 0.02);
    J.row(k) << std::sin(0.8 * t) + 0.3 * std::sin(2.3 * t), v, sign,
        sign / (1.0 + std::pow(v / 0.05, 2.0));
  }
  return J;
}

/// White noise: with 1 - b + b^2/3 and 1.5/b for any design, 90 % of the intervals of the static
/// part hold the truth.
TEST(KernelMoments, IntervalsHoldWhereFewTimesTellANumber) {
  const Eigen::MatrixXd J = friction_columns();
  const LeastNorm fit = least_norm(J);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  IntervalOptions options;
  options.noise = NoiseModel::kCorrelated;
  constexpr int kRuns = 2000;
  int held = 0;
  for (int run = 0; run < kRuns; ++run) {
    Eigen::VectorXd noise(J.rows());
    for (double& value : noise) value = normal(random);
    const Eigen::VectorXd error = fit.solve(noise);
    const ParameterCovariance known =
        parameter_covariance(noise - J * error, J, {J.rows()}, options);
    held += std::abs(error[3]) <= known.above[3] ? 1 : 0;
  }
  RecordProperty("held", held);
  EXPECT_GE(held, 0.94 * kRuns);
  EXPECT_LE(held, 0.985 * kRuns);
}

}  // namespace
}  // namespace codesign
