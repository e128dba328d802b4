// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/anti_windup.h"

#include <gtest/gtest.h>

#include <complex>

#include "math/differences.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

TEST(Clamp, CutsBeyondItsBoundsAlone) {
  const Bounds<double> two{-2.0, 2.0, true};
  EXPECT_EQ(clamp(0.5, two), 0.5);
  EXPECT_EQ(clamp(3.0, two), 2.0);
  EXPECT_EQ(clamp(-3.0, two), -2.0);
  EXPECT_EQ(clamp(0.0, Bounds<double>{}), 0.0);
  EXPECT_EQ(clamp(-3.0, Bounds<double>{-0.5, 2.0, false}), -0.5);
}

TEST(Clamp, HasTheDerivativeOfTheInsideOnTheBound) {
  const Complex x(2.0, kStep);
  const Bounds<Complex> bound{Complex(-2.0, -3.0 * kStep), Complex(2.0, 3.0 * kStep), true};
  EXPECT_EQ(clamp(x, bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(-2.0, kStep), bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(2.1, kStep), bound).imag(), 3.0 * kStep);
  EXPECT_EQ(clamp(Complex(-2.1, kStep), bound).imag(), -3.0 * kStep);
}

TEST(ClampedIntegral, StopsAtTheBoundAndLeavesItAtOnce) {
  // i = 4, bound 2: the bound is s = 0.5, and errors of 0.005 are small.
  constexpr double kSmall = 1e-5;
  const Bounds<double> two{-2.0, 2.0, true};
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, 4.0, two), 0.0, kSmall);
  EXPECT_LE(clamped_integral_rate(3.0, 0.5, 4.0, two), 0.0) << "never beyond the bound";
  EXPECT_LE(clamped_integral_rate(0.001, 0.5, 4.0, two), 0.0);
  EXPECT_NEAR(clamped_integral_rate(-3.0, 0.5, 4.0, two), -3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(-3.0, -0.5, 4.0, two), 0.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, -0.5, 4.0, two), 3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.25, 4.0, two), 3.0 * (1.0 - 1.0 / 256.0), kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, -4.0, two), 0.0, kSmall)
      << "the sign of the gain does not matter";
  EXPECT_NEAR(clamped_integral_rate(0.0, 0.5, 4.0, two), -0.0025, 1e-15)
      << "half of the small error, inwards";
  EXPECT_EQ(clamped_integral_rate(3.0, 0.0, 4.0, two), 3.0);
  EXPECT_EQ(clamped_integral_rate(3.0, 7.0, 0.0, two), 3.0) << "without a gain nothing is bounded";
}

TEST(ClampedIntegral, HasABoundOnEachSide) {
  // i = 4: the bounds are s = -0.25 and 0.5.
  constexpr double kSmall = 1e-5;
  const Bounds<double> bounds{-1.0, 2.0, false};
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, 4.0, bounds), 0.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(-3.0, -0.25, 4.0, bounds), 0.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, -0.25, 4.0, bounds), 3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.25, -4.0, bounds), 0.0, kSmall)
      << "i s is negative, and the lower bound counts";
}

TEST(BackCalculation, TakesOffWhatIsBeyond) {
  EXPECT_EQ(tracked(1.5, 0.5), 3.0);
  EXPECT_EQ(tracked(-1.5, 0.5), -3.0);
  EXPECT_EQ(tracked(1.5, -0.5), -3.0) << "a negative gain";
  EXPECT_EQ(tracked(1.5, 0.0), 0.0) << "without a gain nothing is integrated";
}

TEST(ConditionalIntegration, FadesBeyondTheLimit) {
  const Bounds<double> limit{-1.0, 3.0, false};  // the band is 0.04
  const auto rate = [&limit](double e, double v, double i = 2.0) {
    return conditional_integral_rate(e, i, v, limit);
  };
  EXPECT_EQ(rate(5.0, 2.9), 5.0);
  EXPECT_EQ(rate(5.0, 3.0), 5.0) << "at the limit";
  EXPECT_NEAR(rate(5.0, 3.01), 5.0 * 0.75, 1e-12);
  EXPECT_EQ(rate(5.0, 3.05), 0.0);
  EXPECT_EQ(rate(-5.0, 3.05), -5.0) << "the error leads back";
  EXPECT_EQ(rate(5.0, -1.5), 5.0);
  EXPECT_EQ(rate(-5.0, -1.5), 0.0);
  EXPECT_NEAR(rate(-5.0, -1.03), -5.0 * 0.25, 1e-12);
  EXPECT_EQ(rate(-5.0, 3.05, -2.0), 0.0) << "a negative gain";
  EXPECT_EQ(rate(5.0, 3.05, -2.0), 5.0);
}

// Continuous, and differentiable beside its kinks.
TEST(ConditionalIntegration, DerivativesAreExact) {
  const auto rate = [](const Eigen::VectorXcd& x) {
    const Bounds<Complex> limit{x[3], x[4], false};
    return Eigen::VectorXcd::Constant(1, conditional_integral_rate(x[0], x[1], x[2], limit));
  };
  for (const double v : {2.5, 3.01, 3.2, -1.01, -2.0}) {
    Eigen::VectorXd x(5);
    x << (v > 0.0 ? 0.7 : -0.7), 2.0, v, -1.0, 3.0;
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      Eigen::VectorXcd stepped = x;
      stepped[k] += Complex(0.0, kStep);
      const double exact = rate(stepped)[0].imag() / kStep;
      const double difference = ridders_derivative(
                                    [&](double at) {
                                      Eigen::VectorXcd moved = x;
                                      moved[k] = at;
                                      return rate(moved)[0].real();
                                    },
                                    x[k], 1e-3)
                                    .value;
      EXPECT_NEAR(exact, difference, 1e-8) << v << " " << k;
    }
  }
}

}  // namespace
}  // namespace codesign
