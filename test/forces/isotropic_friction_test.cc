// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/isotropic_friction.h"

#include <gtest/gtest.h>

#include "forces/brown_mcphee.h"
#include "math/derivative_check.h"

namespace codesign {
namespace {

constexpr double kIsotropicMuS = 0.4, kIsotropicMuD = 0.3, kIsotropicVt = 0.01;

/// S(|u|)/|u| as a function of u.u.
template <class T>
T per_speed(const T& square) {
  return friction_per_speed<T>(square, T(kIsotropicMuS), T(kIsotropicMuD), T(kIsotropicVt));
}

/// The derivative of the load at N = 7 by the slip, by the complex step.
Eigen::MatrixXd expected_slope(const Eigen::Vector3d& u) {
  using C = std::complex<double>;
  const auto law = [](const Eigen::VectorXcd& z) { return Eigen::VectorXcd(isotropic_friction<C, 3>(z.head<3>(), C(7.0), per_speed<C>)); };
  return complex_step_jacobian(law, u);
}

TEST(IsotropicFriction, IsTheScalarLawAlongTheSlip) {
  for (double s : {1e-5, 0.0007, 0.0009, 0.01, 0.02, 0.5}) {
    const double S = brown_mcphee(s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
    EXPECT_NEAR(friction_per_speed(s * s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt) * s, S, 1e-15) << s;
    const Eigen::Vector2d u(0.6 * s, -0.8 * s);
    const auto f = isotropic_friction<double, 2>(u, 7.0, per_speed<double>);
    EXPECT_NEAR((f - 7.0 * S * Eigen::Vector2d(0.6, -0.8)).norm(), 0.0, 1e-13) << s;
  }
}

TEST(IsotropicFriction, AtRestItIsLinear) {
  const auto f = isotropic_friction<double, 3>(Eigen::Vector3d::Zero(), 7.0, per_speed<double>);
  EXPECT_EQ(f.norm(), 0.0);
  // S'(0) = (4 mu_d + 16/9 (mu_s - mu_d))/v_t in every direction.
  const Eigen::Matrix3d by_slip = expected_slope(Eigen::Vector3d::Zero());
  EXPECT_NEAR((by_slip - 7.0 * (4.0 * kIsotropicMuD + 16.0 / 9.0 * 0.1) / kIsotropicVt * Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-11);
}

TEST(IsotropicFriction, LanesCarryTheDerivatives) {
  using L = Lanes<4>;
  for (double s : {0.0, 1e-4, 0.00079, 0.0008, 0.012, 0.3}) {
    const Eigen::Vector3d at(0.36 * s, -0.48 * s, 0.8 * s);
    Eigen::Matrix<L, 3, 1> u = at.cast<L>();
    for (int k = 0; k < 3; ++k) u[k].v[k] = 1.0;
    const auto lanes = isotropic_friction<L, 3>(u, L(7.0), per_speed<L>);
    Eigen::Matrix3d by_slip;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) by_slip(row, column) = lanes[row].v[column];
    EXPECT_LT(compare_jacobians(by_slip, expected_slope(at)).largest, 1e-13) << s;
  }
}

TEST(IsotropicFriction, LengthHasNoSlopeAtRest) {
  Eigen::Matrix<Lanes<4>, 2, 1> u(Lanes<4>(0.0), Lanes<4>(0.0));
  u[0].v[0] = 1.0;
  EXPECT_EQ((length_of<Lanes<4>, 2>(u).v[0]), 0.0);
  u[0].a = 0.3;
  u[1].a = 0.4;
  EXPECT_NEAR((length_of<Lanes<4>, 2>(u).a), 0.5, 1e-16);
  EXPECT_NEAR((length_of<Lanes<4>, 2>(u).v[0]), 0.6, 1e-15);
}

}  // namespace
}  // namespace codesign
