// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/clamp.h"

#include <gtest/gtest.h>

#include <complex>

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

TEST(Clamp, CutsBeyondItsBoundsAlone) {
  EXPECT_EQ(clamp(0.5, 2.0), 0.5);
  EXPECT_EQ(clamp(3.0, 2.0), 2.0);
  EXPECT_EQ(clamp(-3.0, 2.0), -2.0);
  EXPECT_EQ(clamp(0.0, 0.0), 0.0);
}

TEST(Clamp, HasTheDerivativeOfTheInsideOnTheBound) {
  const Complex x(2.0, kStep), bound(2.0, 3.0 * kStep);
  EXPECT_EQ(clamp(x, bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(-2.0, kStep), bound).imag(), kStep);
  EXPECT_EQ(clamp(Complex(2.1, kStep), bound).imag(), 3.0 * kStep);
  EXPECT_EQ(clamp(Complex(-2.1, kStep), bound).imag(), -3.0 * kStep);
}

TEST(ClampedIntegral, StopsAtTheBoundAndLeavesItAtOnce) {
  // i = 4, bound 2: the bound is s = 0.5, and errors of 0.005 are small.
  constexpr double kSmall = 1e-5;
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, 4.0, 2.0), 0.0, kSmall);
  EXPECT_LE(clamped_integral_rate(3.0, 0.5, 4.0, 2.0), 0.0) << "never beyond the bound";
  EXPECT_LE(clamped_integral_rate(0.001, 0.5, 4.0, 2.0), 0.0);
  EXPECT_NEAR(clamped_integral_rate(-3.0, 0.5, 4.0, 2.0), -3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(-3.0, -0.5, 4.0, 2.0), 0.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, -0.5, 4.0, 2.0), 3.0, kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.25, 4.0, 2.0), 3.0 * (1.0 - 1.0 / 256.0), kSmall);
  EXPECT_NEAR(clamped_integral_rate(3.0, 0.5, -4.0, 2.0), 0.0, kSmall) << "the sign of the gain does not matter";
  EXPECT_NEAR(clamped_integral_rate(0.0, 0.5, 4.0, 2.0), -0.0025, 1e-15) << "half of the small error, inwards";
  EXPECT_EQ(clamped_integral_rate(3.0, 0.0, 4.0, 2.0), 3.0);
  EXPECT_EQ(clamped_integral_rate(3.0, 7.0, 0.0, 2.0), 3.0) << "without a gain nothing is bounded";
}

}  // namespace
}  // namespace codesign
