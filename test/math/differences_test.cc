// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "math/differences.h"

namespace codesign {
namespace {

Eigen::VectorXcd cubic(const Eigen::VectorXcd& x) {
  Eigen::VectorXcd y(2);
  y << x[0] * x[0] * x[1], std::sin(x[1]);
  return y;
}

Eigen::MatrixXd cubic_jacobian(const Eigen::VectorXd& x) {
  Eigen::MatrixXd J(2, 2);
  J << 2.0 * x[0] * x[1], x[0] * x[0], 0.0, std::cos(x[1]);
  return J;
}

const Eigen::VectorXd kPoint = (Eigen::VectorXd(2) << 1.3, -0.7).finished();

TEST(DerivativeCheck, AcceptsARightJacobian) {
  EXPECT_LT(compare_jacobians(cubic_jacobian(kPoint), complex_step_jacobian(cubic, kPoint)).largest,
            1e-15);
}

TEST(DerivativeCheck, CatchesAWrongEntryAndNamesIt) {
  Eigen::MatrixXd wrong = cubic_jacobian(kPoint);
  wrong(1, 1) *= 1.0 + 1e-8;
  const JacobianDifference difference =
      compare_jacobians(wrong, complex_step_jacobian(cubic, kPoint));
  EXPECT_GT(difference.largest, 1e-9);
  EXPECT_EQ(difference.row, 1);
  EXPECT_EQ(difference.column, 1);
}

TEST(DerivativeCheck, CatchesNaNAndWrongShape) {
  Eigen::MatrixXd wrong = cubic_jacobian(kPoint);
  wrong(0, 1) = std::nan("");
  const JacobianDifference difference =
      compare_jacobians(wrong, complex_step_jacobian(cubic, kPoint));
  EXPECT_FALSE(difference.largest < 1.0);
  EXPECT_GT(compare_jacobians(Eigen::MatrixXd(1, 2), complex_step_jacobian(cubic, kPoint)).largest,
            1.0);
}

TEST(Ridders, ExtrapolatesToNearRounding) {
  const RiddersDerivative d = ridders_derivative([](double x) { return std::exp(x); }, 0.5, 0.1);
  EXPECT_NEAR(d.value, std::exp(0.5), 1e-11);
  EXPECT_LT(d.error, 1e-9);
}

TEST(Ridders, IsExactForAPolynomialOfLowDegree) {
  // d/dx (x^5 - 2 x^2) at 1.5: 5 * 5.0625 - 6.
  const RiddersDerivative d =
      ridders_derivative([](double x) { return std::pow(x, 5) - 2.0 * x * x; }, 1.5, 0.5);
  EXPECT_NEAR(d.value, 19.3125, 1e-11);
  EXPECT_LT(d.error, 1e-9);
}

TEST(Ridders, ExtrapolationBeatsACentralDifferenceOfTheSameSteps) {
  const double step = 0.2, exact = std::exp(0.3);
  const RiddersDerivative d = ridders_derivative([](double x) { return std::exp(x); }, 0.3, step);
  const double smallest = step / 32.0,
               difference =
                   (std::exp(0.3 + smallest) - std::exp(0.3 - smallest)) / (2.0 * smallest);
  EXPECT_LT(std::abs(d.value - exact), 1e-12);
  EXPECT_GT(std::abs(difference - exact), 1e-6);
}

TEST(Ridders, TheEstimateCoversTheErrorOfALongStep) {
  const double t = std::tanh(0.6), exact = 30.0 * (1.0 - t * t);
  const RiddersDerivative d =
      ridders_derivative([](double x) { return std::tanh(30.0 * x); }, 0.02, 0.1);
  EXPECT_GT(d.error, 1e-8);
  EXPECT_LT(std::abs(d.value - exact), d.error);
}

TEST(Ridders, CallsTwicePerLevel) {
  int calls = 0;
  ridders_derivative([&calls](double x) { return ++calls, x; }, 0.0, 1.0);
  EXPECT_EQ(calls, 12);
}

}  // namespace

}  // namespace codesign
