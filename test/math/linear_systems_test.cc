// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/linear_systems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace codesign {
namespace {

using Eigen::MatrixXd;

TEST(LinearSystems, BalancesStatesOfDifferentUnits) {
  // s^2 + 3 s + 2 in units in which position and velocity differ by 2^40.
  const double unit = std::exp2(40);
  MatrixXd A(2, 2);
  A << 0.0, unit, -2.0 / unit, -3.0;
  const SystemEigen eigen = system_eigen(A);
  std::vector<double> values{eigen.values[0].real(), eigen.values[1].real()};
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(values[0], -2.0, 1e-14);
  EXPECT_NEAR(values[1], -1.0, 1e-14);
  for (int k = 0; k < 2; ++k) {
    EXPECT_LT((A * eigen.vectors.col(k) - eigen.values[k] * eigen.vectors.col(k)).norm(),
              1e-12 * unit * eigen.vectors.col(k).norm());
    EXPECT_LT(eigen.uncertainty[k], 1e-10);
  }
}

TEST(LinearSystems, KnowsThatADoubleEigenvalueIsUncertain) {
  MatrixXd A(2, 2);
  A << -1.0, 1.0, 0.0, -1.0;
  const SystemEigen eigen = system_eigen(A);
  EXPECT_GT(eigen.uncertainty.minCoeff(), 1e-8);
  EXPECT_LT(eigen.uncertainty.maxCoeff(), 1e-4);
  EXPECT_EQ(system_eigen(MatrixXd(0, 0)).values.size(), 0);
}

TEST(LinearSystems, ExponentialOfATurnAndOfANilpotentMatrix) {
  for (const double angle : {1e-3, 1.0, 30.0, 1000.0}) {
    MatrixXd A(2, 2);
    A << 0.0, -angle, angle, 0.0;
    const MatrixXd R = matrix_exponential(A);
    EXPECT_NEAR(R(0, 0), std::cos(angle), 1e-12 * (1.0 + angle));
    EXPECT_NEAR(R(1, 0), std::sin(angle), 1e-12 * (1.0 + angle));
  }
  MatrixXd N = MatrixXd::Zero(3, 3);
  N(0, 1) = N(1, 2) = 10.0;
  const MatrixXd E = matrix_exponential(N);
  EXPECT_NEAR(E(0, 2), 50.0, 1e-12);
  EXPECT_NEAR(E(0, 1), 10.0, 1e-13);
  EXPECT_TRUE(matrix_exponential(MatrixXd(MatrixXd::Zero(2, 2))).isIdentity(1e-15));
}

TEST(LinearSystems, TransferFunctionOfAThirdOrderLag) {
  // 2/(s (s + 1) (s + 2)) in controllable form, and 5 beside it.
  MatrixXd A(3, 3);
  A << 0, 1, 0, 0, 0, 1, 0, -2, -3;
  const TransferFunction G(A, Eigen::Vector3d(0, 0, 1), Eigen::RowVector3d(2, 0, 0), 5.0);
  for (const double w : {0.01, 1.0, 100.0}) {
    const std::complex<double> s(0.0, w), expected = 2.0 / (s * (s + 1.0) * (s + 2.0)) + 5.0;
    EXPECT_LT(std::abs(G.at(s) - expected), 1e-13 * std::abs(expected));
  }
  EXPECT_EQ(G.at_infinity(), 5.0);
  EXPECT_EQ(
      TransferFunction(MatrixXd(0, 0), Eigen::VectorXd(0), Eigen::RowVectorXd(0), 3.0).at(1.0),
      3.0);
}

Eigen::MatrixXcd complex_example() {
  Eigen::MatrixXcd A(3, 3);
  using C = std::complex<double>;
  A << C(1.0, 2.0), C(1e5, 0.0), C(0.0, 3.0), C(2e-5, 1e-5), C(-1.0, 0.5), C(4e-5, 0.0),
      C(1.0, 1.0), C(3e5, -1e5), C(0.3, 0.0);
  return A;
}

// States whose units differ by 1e5.
TEST(LinearSystems, ComplexEigenvaluesWithTheirVectors) {
  const Eigen::MatrixXcd A = complex_example();
  const Eigen::VectorXcd values = complex_eigenvalues(A);
  for (const EigenTriple& pole : complex_eigen(A)) {
    EXPECT_LT((values.array() - pole.value).abs().minCoeff(), 1e-13);
    EXPECT_LT((A * pole.right - pole.value * pole.right).norm(), 1e-12 * pole.right.norm());
    EXPECT_LT((pole.left.transpose() * A - pole.value * pole.left.transpose()).norm(),
              1e-7 * pole.left.norm());
    EXPECT_LT(std::abs((pole.left.transpose() * pole.right)(0, 0) - 1.0), 1e-13);
  }
  EXPECT_LT(std::abs(values.sum() - A.trace()), 1e-13);
}

TEST(LinearSystems, TheLargestGain) {
  Eigen::MatrixXcd A(2, 2);
  A << std::complex<double>(0.0, 3.0), 0.0, 0.0, std::complex<double>(-5.0, 0.0);
  const LargestGain gain = largest_gain(A);
  EXPECT_NEAR(gain.value, 5.0, 1e-15);
  EXPECT_LT(std::abs(gain.left.dot(A * gain.right) - 5.0), 1e-14);
}

}  // namespace
}  // namespace codesign
