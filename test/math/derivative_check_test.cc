// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/derivative_check.h"

#include <gtest/gtest.h>

#include "math/ridders.h"

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
  EXPECT_LT(compare_jacobians(cubic_jacobian(kPoint), complex_step_jacobian(cubic, kPoint)).largest, 1e-15);
}

TEST(DerivativeCheck, CatchesAWrongEntryAndNamesIt) {
  Eigen::MatrixXd wrong = cubic_jacobian(kPoint);
  wrong(1, 1) *= 1.0 + 1e-8;
  const JacobianDifference difference = compare_jacobians(wrong, complex_step_jacobian(cubic, kPoint));
  EXPECT_GT(difference.largest, 1e-9);
  EXPECT_EQ(difference.row, 1);
  EXPECT_EQ(difference.column, 1);
}

TEST(DerivativeCheck, CatchesNaNAndWrongShape) {
  Eigen::MatrixXd wrong = cubic_jacobian(kPoint);
  wrong(0, 1) = std::nan("");
  const JacobianDifference difference = compare_jacobians(wrong, complex_step_jacobian(cubic, kPoint));
  EXPECT_FALSE(difference.largest < 1.0);
  EXPECT_GT(compare_jacobians(Eigen::MatrixXd(1, 2), complex_step_jacobian(cubic, kPoint)).largest, 1.0);
}

TEST(Ridders, ExtrapolatesToNearRounding) {
  const RiddersDerivative d = ridders_derivative([](double x) { return std::exp(x); }, 0.5, 0.1);
  EXPECT_NEAR(d.value, std::exp(0.5), 1e-11);
  EXPECT_LT(d.error, 1e-9);
}

}  // namespace
}  // namespace codesign
