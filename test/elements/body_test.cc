// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "elements/body.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

template <class T>
BodyConstants<T> constants() {
  BodyConstants<T> body;
  body.mass = T(2.5);
  body.J << T(0.3), T(0.02), T(-0.01), T(0.02), T(0.4), T(0.03), T(-0.01), T(0.03), T(0.2);
  return body;
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

}  // namespace
}  // namespace codesign
