// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/waypoint_piece.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

double value(const std::array<double, 6>& c, double t) {
  double sum = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * t + c[k];
  return sum;
}

double slope(const std::array<double, 6>& c, double t) {
  double sum = 0.0;
  for (std::size_t k = c.size() - 1; k > 0; --k) sum = sum * t + static_cast<double>(k) * c[k];
  return sum;
}

TEST(WaypointPolynomial, MeetsTheEndsInPositionAndFromTheThirdDegreeOnInVelocity) {
  const Knot<double> from{1.0, 2.0, -3.0}, to{-0.5, 4.0, 5.0};
  for (Interpolation degree : {Interpolation::kLinear, Interpolation::kCubic, Interpolation::kQuintic}) {
    const auto c = waypoint_polynomial(degree, from, to, 0.5);
    EXPECT_EQ(value(c, 0.0), 1.0);
    EXPECT_NEAR(value(c, 0.5), -0.5, 1e-13);
    if (degree == Interpolation::kLinear) {
      EXPECT_NEAR(slope(c, 0.2), -3.0, 1e-13);
      continue;
    }
    EXPECT_EQ(slope(c, 0.0), 2.0);
    EXPECT_NEAR(slope(c, 0.5), 4.0, 1e-12);
  }
  EXPECT_EQ(waypoint_polynomial(Interpolation::kQuintic, from, to, 0.5)[2], -1.5);
}

}  // namespace
}  // namespace codesign
