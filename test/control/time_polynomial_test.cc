// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/time_polynomial.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

// 1 + 2 x - x^3 + x^5 with x = t - 3 = 2.
TEST(TimePolynomial, HasThreeDerivativesAndAnIntegral) {
  const TimePolynomial<double> polynomial{3.0, {1.0, 2.0, 0.0, -1.0, 0.0, 1.0}};
  const ReferenceMotion<double> motion = polynomial.at(5.0);
  EXPECT_EQ(motion.value, 1.0 + 4.0 - 8.0 + 32.0);
  EXPECT_EQ(motion.rate, 2.0 - 12.0 + 80.0);
  EXPECT_EQ(motion.acceleration, -12.0 + 160.0);
  EXPECT_EQ(motion.jerk, -6.0 + 240.0);
  EXPECT_NEAR(polynomial.area(2.0), 2.0 + 4.0 - 4.0 + 64.0 / 6.0, 1e-14);
  EXPECT_EQ(polynomial.at(3.0).value, 1.0);
  EXPECT_EQ(polynomial.area(0.0), 0.0);
}

}  // namespace
}  // namespace codesign
