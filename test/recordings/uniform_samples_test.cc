// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/uniform_samples.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

std::vector<double> values_at(const std::vector<double>& times, double (*f)(double)) {
  std::vector<double> values;
  for (const double t : times) values.push_back(f(t));
  return values;
}

double parabola(double t) { return 1.0 - 2.0 * t + 3.0 * t * t; }
double line(double t) { return 4.0 - 0.5 * t; }

TEST(UniformTimes, EqualStepsNeedNoInterpolation) {
  const UniformTimes times = uniform_times({1.0, 1.1, 1.2, 1.3, 1.4});
  EXPECT_TRUE(times.exact);
  EXPECT_EQ(times.count, 5);
  EXPECT_NEAR(times.step, 0.1, 1e-15);
  EXPECT_NEAR(times.rate(), 10.0, 1e-12);
  EXPECT_NEAR(times.at(4), 1.4, 1e-15);
}

TEST(UniformTimes, APauseCountsAsWholePeriods) {
  const UniformTimes times = uniform_times({0.0, 0.1, 0.2, 0.5, 0.6, 0.7, 0.8});
  EXPECT_FALSE(times.exact);
  EXPECT_EQ(times.count, 9);
  EXPECT_NEAR(times.step, 0.1, 1e-15);
}

TEST(UniformTimes, JitterBelowAThousandthIsNone) {
  EXPECT_TRUE(uniform_times({0.0, 1.0005, 1.9995, 3.0}).exact);
  EXPECT_FALSE(uniform_times({0.0, 1.002, 2.0, 3.0}).exact);
}

TEST(Resample, CubicsAreExactForParabolasAndLinesForLines) {
  const std::vector<double> times = {0.0, 0.9, 2.1, 3.0, 4.2, 4.9, 6.0};
  const UniformTimes uniform = uniform_times(times);
  ASSERT_FALSE(uniform.exact);
  const Eigen::VectorXd cubic = resample(times, values_at(times, parabola), uniform, Between::kCubic);
  const Eigen::VectorXd linear = resample(times, values_at(times, line), uniform, Between::kLinear);
  for (Eigen::Index k = 0; k < uniform.count; ++k) {
    EXPECT_NEAR(cubic[k], parabola(uniform.at(k)), 1e-12);
    EXPECT_NEAR(linear[k], line(uniform.at(k)), 1e-12);
  }
}

TEST(Resample, LinesDoNotOvershootAtAJump) {
  const std::vector<double> times = {0.0, 1.0, 2.1, 3.0, 3.9, 5.0};
  const std::vector<double> jump = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
  const UniformTimes uniform = uniform_times(times);
  const Eigen::VectorXd linear = resample(times, jump, uniform, Between::kLinear), cubic = resample(times, jump, uniform, Between::kCubic);
  EXPECT_GE(linear.minCoeff(), 0.0);
  EXPECT_LE(linear.maxCoeff(), 1.0);
  EXPECT_GT(cubic.maxCoeff() - cubic.minCoeff(), 1.0);
}

TEST(Derivative, IsExactForPolynomialsOfItsOrder) {
  const double step = 0.1;
  const auto power = [step](int degree) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(21, [=](Eigen::Index k) { return std::pow(step * double(k - 10), degree); }));
  };
  const auto expected = [step](int degree, Eigen::Index k) { return degree * std::pow(step * double(k - 10), degree - 1); };
  const Eigen::VectorXd eighth = derivative(power(8), step), second = derivative(power(2), step);
  for (Eigen::Index k = 4; k < 17; ++k) EXPECT_NEAR(eighth[k], expected(8, k), 1e-12) << k;
  EXPECT_GT(std::abs(eighth[3] - expected(8, 3)), 1e-6);
  for (Eigen::Index k = 0; k < 21; ++k) EXPECT_NEAR(second[k], expected(2, k), 1e-12) << k;
}

// At 100 Hz, a motion of 20 Hz: differences of order two would lose a quarter of its velocity.
TEST(Derivative, HoldsUpToAFifthOfTheRate) {
  const double step = 0.01, w = 2.0 * 3.14159265358979323846 * 20.0;
  const Eigen::VectorXd wave = Eigen::VectorXd::NullaryExpr(101, [=](Eigen::Index k) { return std::sin(w * step * double(k)); });
  EXPECT_NEAR(derivative(wave, step)[50], w * std::cos(w * step * 50.0), 0.01 * w);
}

TEST(Integral, IsExactForPolynomialsOfItsOrder) {
  const double step = 0.1;
  const auto power = [step](int degree) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(21, [=](Eigen::Index k) { return std::pow(step * double(k - 10), degree); }));
  };
  const auto expected = [step](int degree, Eigen::Index k) {
    return (std::pow(step * double(k - 10), degree + 1) - std::pow(-10.0 * step, degree + 1)) / (degree + 1);
  };
  const Eigen::VectorXd third = integral(power(3), step), fifth = integral(power(5), step);
  EXPECT_EQ(third[0], 0.0);
  for (Eigen::Index k = 0; k < 21; ++k) EXPECT_NEAR(third[k], expected(3, k), 1e-13) << k;
  for (Eigen::Index k = 2; k < 19; ++k) EXPECT_NEAR(fifth[k] - fifth[2], expected(5, k) - expected(5, 2), 1e-13) << k;
  EXPECT_GT(std::abs(fifth[1] - expected(5, 1)), 1e-6);
}

// At 100 Hz, a motion of 10 Hz: the trapezoidal rule would lose 3 % of its amplitude.
TEST(Integral, UndoesTheDerivative) {
  const double step = 0.01, w = 2.0 * 3.14159265358979323846 * 10.0;
  const Eigen::VectorXd wave = Eigen::VectorXd::NullaryExpr(201, [=](Eigen::Index k) { return std::sin(w * step * double(k) + 0.3); });
  const Eigen::VectorXd again = integral(derivative(wave, step), step);
  for (Eigen::Index k = 10; k < 191; ++k) EXPECT_NEAR(again[k] - again[10], wave[k] - wave[10], 3e-3) << k;
}

}  // namespace
}  // namespace codesign
