// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/euler_parameters.h"

#include <gtest/gtest.h>

#include "math/differences.h"

namespace codesign {
namespace {

const Vector4<double> kP(0.7, -0.3, 0.5, 0.2), kR(0.1, 0.4, -0.6, 0.9);
const Vector3<double> kS(0.3, -0.8, 0.5), kB(-0.2, 0.6, 1.1);

TEST(EulerParameters, RotatesAQuarterTurnAboutZ) {
  const double h = std::sqrt(0.5);
  const Matrix3<double> A = rotation(Vector4<double>(h, 0.0, 0.0, h));
  EXPECT_NEAR((A * Vector3<double>(1.0, 0.0, 0.0) - Vector3<double>(0.0, 1.0, 0.0)).norm(), 0.0,
              1e-15);
}

TEST(EulerParameters, JacobianOfARotatedVector) {
  const auto f = [](const Eigen::VectorXcd& p) -> Eigen::VectorXcd {
    return rotation<std::complex<double>>(Vector4<std::complex<double>>(p)) *
           kS.cast<std::complex<double>>();
  };
  EXPECT_LT(
      compare_jacobians(rotated_vector_jacobian(kP, kS), complex_step_jacobian(f, kP)).largest,
      1e-15);
  EXPECT_NEAR((rotation_derivative(kP, kR) * kS - rotated_vector_jacobian(kP, kS) * kR).norm(), 0.0,
              1e-15);
  EXPECT_NEAR((rotation_derivative(kP, kP) - 2.0 * rotation(kP)).norm(), 0.0, 1e-15);
}

TEST(EulerParameters, HessianIsConstantInP) {
  const Matrix3<double> W = kB * kS.transpose();
  EXPECT_NEAR((rotated_vector_jacobian(kP, kS).transpose() * kB - rotation_hessian(W) * kP).norm(),
              0.0, 1e-14);
  EXPECT_NEAR((rotation_hessian_product(W, kP) - rotation_hessian(W) * kP).norm(), 0.0, 1e-14);
}

TEST(EulerParameters, RatesAreAngularVelocities) {
  const Vector4<double> p = kP.normalized();
  const Vector3<double> omega(0.4, -1.2, 0.7);
  const Vector4<double> pd = 0.5 * ground_rate_matrix(p).transpose() * omega;
  const Matrix3<double> Ad = rotation_derivative(p, pd);
  EXPECT_NEAR((Ad * kS - omega.cross(rotation(p) * kS)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((2.0 * ground_rate_matrix(p) * pd - omega).norm(), 0.0, 1e-14);
  EXPECT_NEAR((2.0 * body_rate_matrix(p) * pd - rotation(p).transpose() * omega).norm(), 0.0,
              1e-14);
  EXPECT_NEAR((body_rate_matrix(kP).transpose() * kB - body_rate_hessian(kB) * kP).norm(), 0.0,
              1e-15);
  EXPECT_NEAR((body_rate(kP, kR) - body_rate_matrix(kP) * kR).norm(), 0.0, 1e-15);
  EXPECT_NEAR((body_rate_transposed(kP, kB) - body_rate_matrix(kP).transpose() * kB).norm(), 0.0,
              1e-15);
  EXPECT_NEAR((body_rate_matrix(kP) * kR + body_rate_matrix(kR) * kP).norm(), 0.0, 1e-15);
}

TEST(EulerParameters, ComeBackFromEveryQuadrant) {
  for (int largest = 0; largest < 4; ++largest) {
    Vector4<double> p(0.1, -0.2, 0.15, 0.05);
    p[largest] = 0.9;
    p.normalize();
    const Vector4<double> back = euler_parameters<double>(rotation(p));
    EXPECT_NEAR(std::abs(back.dot(p)), 1.0, 1e-15) << largest;
  }
  EXPECT_NEAR((rotation(quaternion_product(kP, kR)) - rotation(kP) * rotation(kR)).norm(), 0.0,
              1e-14);
}

}  // namespace
}  // namespace codesign
