// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/isotropic_friction.h"

#include <gtest/gtest.h>

#include "forces/brown_mcphee.h"
#include "math/derivative_check.h"

namespace codesign {
namespace {

constexpr double kIsotropicMuS = 0.4, kIsotropicMuD = 0.3, kIsotropicVt = 0.01;

TEST(IsotropicFriction, IsTheScalarLawAlongTheSlip) {
  for (double s : {1e-5, 0.0007, 0.0009, 0.01, 0.02, 0.5}) {
    const double S = brown_mcphee(s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt).value;
    EXPECT_NEAR(friction_per_speed(s * s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt).value * s, S, 1e-15) << s;
    const Eigen::Vector2d u(0.6 * s, -0.8 * s);
    const auto f = isotropic_friction<double, 2>(u, 7.0, kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
    EXPECT_NEAR((f.load - 7.0 * S * Eigen::Vector2d(0.6, -0.8)).norm(), 0.0, 1e-13) << s;
  }
}

TEST(IsotropicFriction, AtRestItIsLinear) {
  const auto f = isotropic_friction<double, 3>(Eigen::Vector3d::Zero(), 7.0, kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
  EXPECT_EQ(f.load.norm(), 0.0);
  // S'(0) = (4 mu_d + 16/9 (mu_s - mu_d))/v_t in every direction.
  EXPECT_NEAR((f.by_slip - 7.0 * (4.0 * kIsotropicMuD + 16.0 / 9.0 * 0.1) / kIsotropicVt * Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-11);
}

TEST(IsotropicFriction, DerivativesAreExact) {
  using C = std::complex<double>;
  for (double s : {0.0, 1e-4, 0.00079, 0.0008, 0.012, 0.3}) {
    Eigen::VectorXd x(4);
    x << 0.36 * s, -0.48 * s, 0.8 * s, 7.0;
    const auto f = isotropic_friction<double, 3>(x.head<3>(), x[3], kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
    Eigen::MatrixXd J(3, 4);
    J << f.by_slip, f.by_normal;
    const auto law = [](const Eigen::VectorXcd& z) {
      return Eigen::VectorXcd(isotropic_friction<C, 3>(z.head<3>(), z[3], C(kIsotropicMuS), C(kIsotropicMuD), C(kIsotropicVt)).load);
    };
    EXPECT_LT(compare_jacobians(J, complex_step_jacobian(law, x)).largest, 1e-13) << s;
  }
}

TEST(IsotropicFriction, LanesCarryTheDerivatives) {
  using L = Lanes<4>;
  Eigen::Matrix<L, 2, 1> u(L(0.003), L(-0.004));
  u[0].v[1] = 1.0;
  u[1].v[3] = 1.0;
  const auto lanes = isotropic_friction<L, 2>(u, L(7.0), L(kIsotropicMuS), L(kIsotropicMuD), L(kIsotropicVt));
  const auto real = isotropic_friction<double, 2>(Eigen::Vector2d(0.003, -0.004), 7.0, kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(lanes.load[k].v[1], real.by_slip(k, 0), 1e-11);
    EXPECT_NEAR(lanes.load[k].v[3], real.by_slip(k, 1), 1e-11);
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
