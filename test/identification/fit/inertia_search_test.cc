// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/fit/inertia_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "identification/fit/residual_fit.h"

namespace codesign {
namespace {

using BodyNumbers = RelativeInertia::Ten;

const BodyNumbers kStartBody =
    (BodyNumbers() << 0.3, -1.5, -1.2, -1.9, 0.05, -0.03, 0.02, 0.1, -0.2, 0.15).finished();

/// Efforts that are linear in the inertia of one body, times a gain, and a decay of two more
/// numbers: x = (ten numbers, gain, amplitude, rate).
class BodyAndDecay final : public ResidualSource {
 public:
  explicit BodyAndDecay(const Eigen::VectorXd& truth) : relative_(kStartBody) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    regressor_ = Eigen::MatrixXd::NullaryExpr(kRows, 10, [&] { return normal(random); });
    measured_.setZero(kRows);
    Eigen::MatrixXd values;
    EXPECT_TRUE(evaluate(truth, &values, nullptr).ok());
    measured_ = values.col(0) +
                kNoise * Eigen::VectorXd::NullaryExpr(kRows, [&] { return normal(random); });
  }
  static constexpr Eigen::Index kRows = 400;
  static constexpr double kNoise = 1e-3;

  const std::vector<std::string>& outputs() const override { return outputs_; }
  const SeriesLengths& lengths() const override { return lengths_; }
  Status evaluate(const Eigen::VectorXd& x, Eigen::MatrixXd* residuals,
                  Eigen::MatrixXd* jacobian) override {
    const BodyNumbers body = x.head<10>();
    const Eigen::VectorXd efforts = regressor_ * symmetric_numbers(relative_.matrix(body));
    residuals->resize(kRows, 1);
    if (jacobian) jacobian->resize(kRows, 13);
    Eigen::Matrix<double, 10, 10> slopes;
    for (int k = 0; k < 10; ++k) {
      const Eigen::Matrix4d half =
          relative_.factor_slope(body, k) * relative_.factor(body).transpose();
      slopes.col(k) = symmetric_numbers(half + half.transpose());
    }
    if (jacobian) jacobian->leftCols(10) = x[10] * regressor_ * slopes;
    for (Eigen::Index row = 0; row < kRows; ++row) {
      const double t = 0.01 * static_cast<double>(row), decay = std::exp(-x[12] * t);
      (*residuals)(row, 0) = x[10] * efforts[row] + x[11] * decay - measured_[row];
      if (jacobian) jacobian->row(row).tail<3>() << efforts[row], decay, -x[11] * t * decay;
    }
    return {};
  }

 private:
  const RelativeInertia relative_;
  const std::vector<std::string> outputs_{"effort"};
  const SeriesLengths lengths_{kRows};
  Eigen::MatrixXd regressor_;
  Eigen::VectorXd measured_;
};

FitProblem body_and_decay(double amplitude, double rate) {
  const double none = std::numeric_limits<double>::infinity();
  FitProblem problem;
  problem.start.resize(13);
  problem.start << kStartBody, 1.0, amplitude, rate;
  problem.lower = Eigen::VectorXd::Constant(13, -none);
  problem.upper = Eigen::VectorXd::Constant(13, none);
  problem.lower.tail(3) << 1.0, 0.0, 0.0;  // the gain is known
  problem.upper.tail(3) << 1.0, 50.0, 50.0;
  problem.prior.inertias.push_back(
      {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, RelativeInertia(kStartBody), 0.05});
  return problem;
}

Eigen::VectorXd true_numbers(double gain) {
  Eigen::VectorXd truth(13);
  truth << kStartBody, gain, 3.0, 0.7;
  truth[0] += 0.7;
  truth[1] = -8.0;  // a plate
  truth[8] = 0.1;
  return truth;
}

TEST(InertiaSearch, FindsNumbersThatAreNotLinearToo) {
  for (const double rate : {0.05, 0.5, 6.0}) {
    BodyAndDecay source(true_numbers(1.0));
    const ResidualFit fit = fit_residuals(body_and_decay(1.0, rate), &source);
    ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
    EXPECT_TRUE(fit.termination == "success" || fit.termination == "objective_tolerance_reached")
        << fit.termination;
    EXPECT_NEAR(fit.x[12], 0.7, 0.001) << rate;
    EXPECT_NEAR(fit.x[11], 3.0, 0.001) << rate;
    EXPECT_EQ(fit.x[10], 1.0) << "equal bounds fix a number";
    EXPECT_NEAR(fit.spreads[0], BodyAndDecay::kNoise, 0.1 * BodyAndDecay::kNoise);
    EXPECT_LT(fit.x[1], -5.0) << "next to the border";
    EXPECT_LE(fit.evaluations, 30) << rate;
  }
}

TEST(InertiaSearch, AProductOfInertiaAndGainIsFound) {
  BodyAndDecay source(true_numbers(1.5));
  FitProblem problem = body_and_decay(1.0, 0.5);
  problem.upper[10] = 50.0;
  problem.prior.inertias[0].mass = 1e-3;  // and the mass at the start: e^1.4 times too small
  const ResidualFit fit = fit_residuals(problem, &source);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
  EXPECT_NEAR(fit.spreads[0], BodyAndDecay::kNoise, 0.1 * BodyAndDecay::kNoise);
  EXPECT_NEAR(fit.x[10] * std::exp(2.0 * fit.x[0]), 1.5 * std::exp(2.0), 0.01);
}

TEST(InertiaSearch, BoundedNumbersKeepTheirBounds) {
  FitProblem problem = body_and_decay(1.0, 0.5);
  EXPECT_EQ(unbounded_inertias(problem.prior, problem.lower, problem.upper).size(), 1U);
  problem.lower[1] = -3.0;
  EXPECT_TRUE(unbounded_inertias(problem.prior, problem.lower, problem.upper).empty());
  BodyAndDecay source(true_numbers(1.0));
  const ResidualFit fit = fit_residuals(problem, &source);
  ASSERT_TRUE(fit.status.ok()) << fit.status.cause;
  EXPECT_EQ(fit.x[1], -3.0);
}

}  // namespace
}  // namespace codesign
