// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/elementary.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using C = std::complex<double>;
constexpr double kStep = 1e-30;

TEST(SmoothAbs, IsEpsilonAtZeroAndTheModulusFarFromIt) {
  EXPECT_EQ(smooth_abs(0.0, 1e-3), 1e-3);
  EXPECT_EQ(smooth_abs(-3.0, 4.0), 5.0);
  EXPECT_NEAR(smooth_abs(-7.0, 1e-3), 7.0, 1e-7);
}

TEST(SmoothAbs, SlopeIsXOverItself) {
  EXPECT_NEAR(smooth_abs(C(-3.0, kStep), C(4.0)).imag() / kStep, -0.6, 1e-15);
  EXPECT_EQ(smooth_abs(C(0.0, kStep), C(4.0)).imag(), 0.0);
}

TEST(ArcTangent, ComplexValueAndSlopeInEveryQuadrant) {
  for (double x : {-0.8, 0.8}) {
    for (double y : {-0.6, 0.6}) {
      EXPECT_EQ(arc_tangent(C(y), C(x)).real(), std::atan2(y, x));
      // d atan2 = (x dy - y dx) / (x^2 + y^2), and x^2 + y^2 = 1.
      EXPECT_NEAR(arc_tangent(C(y, kStep), C(x)).imag() / kStep, x, 1e-15);
      EXPECT_NEAR(arc_tangent(C(y), C(x, kStep)).imag() / kStep, -y, 1e-15);
    }
  }
}

TEST(ArcTangent, LanesCarryTheSameSlope) {
  Lanes<4> y(0.6), x(-0.8);
  y.v[0] = 1.0;
  x.v[1] = 1.0;
  const Lanes<4> angle = arc_tangent(y, x);
  EXPECT_EQ(angle.a, std::atan2(0.6, -0.8));
  EXPECT_NEAR(angle.v[0], -0.8, 1e-15);
  EXPECT_NEAR(angle.v[1], -0.6, 1e-15);
}

}  // namespace
}  // namespace codesign
