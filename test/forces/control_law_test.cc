// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <complex>

#include "forces/control_law.h"
#include "math/differences.h"

namespace codesign {
namespace {

TEST(Pid, WeighsErrorIntegralAndRate) {
  const Pid<double> law{2.0, 3.0, 5.0};
  EXPECT_EQ(law.output(0.5, -1.0, 4.0), 1.0 - 3.0 + 20.0);
  EXPECT_EQ(Pid<double>().output(1.0, 1.0, 1.0), 0.0);
}

TEST(Pid, GainsAreItsDerivatives) {
  using C = std::complex<double>;
  const Pid<C> law{C(2.0), C(3.0), C(5.0)};
  const C i(0.0, 1.0);
  EXPECT_EQ(law.output(0.5 + i, -1.0, 4.0).imag(), 2.0);
  EXPECT_EQ(law.output(0.5, -1.0 + i, 4.0).imag(), 3.0);
  EXPECT_EQ(law.output(0.5, -1.0, 4.0 + i).imag(), 5.0);
}

TEST(Saturation, ByHand) {
  const auto rest = saturate(0.0, 4.0);
  EXPECT_EQ(rest.value, 0.0);
  EXPECT_EQ(rest.slope, 1.0);
  // At the limit, on either side of the switch between the two forms: u_max / 2^(1/8), slope
  // 2^(-9/8).
  for (double u : {4.0, std::nextafter(4.0, 5.0)}) {
    EXPECT_NEAR(saturate(u, 4.0).value, 4.0 * std::pow(2.0, -0.125), 1e-14);
    EXPECT_NEAR(saturate(u, 4.0).slope, std::pow(2.0, -1.125), 1e-14);
  }
  EXPECT_NEAR(saturate(2.0, 4.0).value, 2.0 / std::pow(1.0 + 1.0 / 256.0, 0.125), 1e-15);
}

TEST(Saturation, IsOddAndStaysWithin) {
  for (double u : {0.3, 3.9, 4.1, 7.0, 1e3, 1e60}) {
    const auto s = saturate(u, 4.0);
    EXPECT_EQ(saturate(-u, 4.0).value, -s.value);
    EXPECT_EQ(saturate(-u, 4.0).slope, s.slope);
    EXPECT_LE(s.value, 4.0);
    EXPECT_GE(s.slope, 0.0);
    EXPECT_TRUE(std::isfinite(s.value));
  }
  EXPECT_NEAR(saturate(1e60, 4.0).value, 4.0, 1e-15);
}

TEST(Saturation, SmallEffortsPassUnchanged) {
  EXPECT_NEAR(saturate(0.04, 4.0).value, 0.04, 1e-17);
  EXPECT_GT(saturate(2.0, 4.0).value, 2.0 * 0.9995);
}

TEST(Saturation, DerivativesAreExact) {
  using C = std::complex<double>;
  for (double u : {-9.0, -3.0, 0.0, 1e-3, 3.99, 4.01, 50.0}) {
    const auto by_u = [](const Eigen::VectorXcd& x) {
      return Eigen::VectorXcd::Constant(1, saturate<C>(x[0], C(4.0)).value);
    };
    const Eigen::MatrixXd slope = Eigen::MatrixXd::Constant(1, 1, saturate(u, 4.0).slope);
    EXPECT_LT(compare_jacobians(slope, complex_step_jacobian(by_u, Eigen::VectorXd::Constant(1, u)))
                  .largest,
              1e-14)
        << u;
    // Lanes carry the derivative by the limit too.
    Lanes<4> limit(4.0);
    limit.v[0] = 1.0;
    const auto by_limit = [u](const Eigen::VectorXcd& x) {
      return Eigen::VectorXcd::Constant(1, saturate<C>(C(u), x[0]).value);
    };
    const Eigen::MatrixXd lane =
        Eigen::MatrixXd::Constant(1, 1, saturate(Lanes<4>(u), limit).value.v[0]);
    EXPECT_LT(
        compare_jacobians(lane, complex_step_jacobian(by_limit, Eigen::VectorXd::Constant(1, 4.0)))
            .largest,
        1e-14)
        << u;
  }
}

}  // namespace

}  // namespace codesign
