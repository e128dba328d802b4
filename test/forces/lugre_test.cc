// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/lugre.h"

#include <gtest/gtest.h>

#include "forces/bristle_fixture.h"

namespace codesign {
namespace {

Bristle<double> at(double u, double zeta) { return lugre<double>({u, 0.0, 0.0}, {{zeta, 0.0, 0.0}, 0.0}, bristle_constants<double>()); }

TEST(LuGre, AtRestItIsASpringAndADamper) {
  const Bristle<double> b = at(0.0, 0.3);
  EXPECT_EQ(b.mu[0], 0.3);
  EXPECT_EQ(b.rate.norm(), 0.0);
}

TEST(LuGre, AtTheStribeckVelocity) {
  // g = 0.4 + 0.1/e; zeta' = 1000 (0.01 - 0.01/g 0.2).
  const double g = 0.4 + 0.1 * std::exp(-1.0), rate = 1000.0 * (0.01 - 0.01 / g * 0.2);
  const Bristle<double> b = at(0.01, 0.2);
  EXPECT_NEAR(b.rate[0], rate, 1e-12);
  EXPECT_NEAR(b.mu[0], 0.2 + 0.005 * rate, 1e-14);
  EXPECT_NEAR(at(-0.01, -0.2).mu[0], -b.mu[0], 1e-16) << "odd";
}

TEST(LuGre, SteadySlidingIsTheStribeckCurve) {
  for (double u : {1e-6, 0.003, 0.02, 1.0}) {
    const double g = 0.4 + 0.1 * std::exp(-u * u / 1e-4);
    EXPECT_NEAR(at(u, g).mu[0], g, 1e-14);
    EXPECT_NEAR(at(u, g).rate[0], 0.0, 1e-9);
  }
}

TEST(LuGre, DoesNotDependOnTheDirection) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d u(0.004, -0.006, 0.002), zeta(0.3, 0.1, -0.2);
  const auto c = bristle_constants<double>();
  const Bristle<double> b = lugre<double>(u, {zeta, 0.0}, c), turned = lugre<double>(R * u, {R * zeta, 0.0}, c);
  EXPECT_NEAR((turned.mu - R * b.mu).norm(), 0.0, 1e-14);
  EXPECT_NEAR((turned.rate - R * b.rate).norm(), 0.0, 1e-11);
}

TEST(LuGre, ParametersEnterTheLanes) { expect_parameter_derivatives(lugre<Lanes<8>>, lugre<std::complex<double>>); }

}  // namespace
}  // namespace codesign
