// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "elements/rigid_body.h"

#include <gtest/gtest.h>

#include "math/derivative_check.h"

namespace codesign {
namespace {

template <class T>
BodyConstants<T> constants() {
  BodyConstants<T> body;
  body.mass = T(2.5);
  body.J << T(0.3), T(0.02), T(-0.01), T(0.02), T(0.4), T(0.03), T(-0.01), T(0.03), T(0.2);
  return body;
}

/// x = [p, p', p''].
template <class T>
BodyKinematics<T> kinematics(const VectorX<T>& x) {
  BodyKinematics<T> k;
  k.p = x.template segment<4>(0);
  k.pd = x.template segment<4>(4);
  k.pdd = x.template segment<4>(8);
  return k;
}

Eigen::VectorXd generic() {
  Eigen::VectorXd x(12);
  for (Eigen::Index k = 0; k < 12; ++k) x[k] = std::sin(1.7 * static_cast<double>(k) + 0.4);
  return x;
}

TEST(RigidBody, MassTimesAcceleration) {
  BodyKinematics<double> k;
  k.rdd = {1.0, -2.0, 3.0};
  Vector3<double> on_r;
  Vector4<double> on_p;
  inertia_force(constants<double>(), k, &on_r, &on_p);
  EXPECT_EQ(on_r, Eigen::Vector3d(2.5, -5.0, 7.5));
  EXPECT_EQ(on_p.norm(), 0.0);
}

TEST(RigidBody, AgreesWithEulersEquations) {
  // For a unit p with omega' = 2 G p' the rows are 2 G^T (J dw/dt + w x J w), up to a multiple of p that the norm's multiplier takes.
  const Vector4<double> p = Vector4<double>(0.5, -0.3, 0.7, 0.2).normalized();
  const Matrix34<double> G = body_rate_matrix(p);
  const Vector3<double> w(1.2, -0.7, 0.4), wd(-0.3, 0.9, 2.0);
  BodyKinematics<double> k;
  k.p = p;
  k.pd = 0.5 * (G.transpose() * w);
  k.pdd = 0.5 * (G.transpose() * wd) - k.pd.squaredNorm() * p;
  Vector3<double> on_r;
  Vector4<double> on_p;
  const BodyConstants<double> body = constants<double>();
  inertia_force(body, k, &on_r, &on_p);
  const Vector3<double> torque = body.J * wd + w.cross(body.J * w);
  // G G^T = I, G p = 0.
  EXPECT_LT((0.5 * (G * on_p) - torque).norm(), 1e-14);
}

TEST(RigidBody, GradientIsExact) {
  const InertiaGradient<double> gradient = inertia_gradient(constants<double>(), kinematics<double>(generic()));
  Eigen::MatrixXd assembled(4, 12);
  assembled << gradient.by_p, gradient.by_pd, gradient.by_pdd;
  const auto force = [](const Eigen::VectorXcd& x) {
    Vector3<std::complex<double>> on_r;
    Vector4<std::complex<double>> on_p;
    inertia_force(constants<std::complex<double>>(), kinematics<std::complex<double>>(x), &on_r, &on_p);
    return Eigen::VectorXcd(on_p);
  };
  EXPECT_LT(compare_jacobians(assembled, complex_step_jacobian(force, generic())).largest, 1e-14);
}

}  // namespace
}  // namespace codesign
