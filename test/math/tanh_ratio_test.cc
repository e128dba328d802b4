// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/tanh_ratio.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(TanhRatio, IsWhatItSays) {
  EXPECT_EQ(tanh_ratio(0.0).value, 1.0);
  EXPECT_NEAR(tanh_ratio(0.0).slope, -1.0 / 3.0, 1e-16);
  for (double x : {1e-4, 0.01, 0.0499, 0.0501, 1.0, 400.0}) {
    EXPECT_NEAR(tanh_ratio(x).value, std::tanh(std::sqrt(x)) / std::sqrt(x), 4e-16) << x;
  }
}

TEST(TanhRatio, IsSmoothWhereTheSeriesEnds) {
  const ValueAndSlope<double> below = tanh_ratio(0.05 - 1e-16), above = tanh_ratio(0.05);
  EXPECT_NEAR(below.value, above.value, 1e-14);
  EXPECT_NEAR(below.slope, above.slope, 1e-14);
}

TEST(TanhRatio, SlopeAndItsLanesAreDerivatives) {
  using C = std::complex<double>;
  for (double x : {0.0, 1e-6, 0.03, 0.0499, 0.0501, 0.7, 16.0, 1600.0}) {
    EXPECT_NEAR(tanh_ratio(x).slope, tanh_ratio(C(x, 1e-30)).value.imag() / 1e-30, 1e-14) << x;
    Lanes<4> lane(x);
    lane.v[2] = 1.0;
    const ValueAndSlope<Lanes<4>> r = tanh_ratio(lane);
    EXPECT_NEAR(r.value.v[2], tanh_ratio(x).slope, 1e-14) << x;
    EXPECT_NEAR(r.slope.v[2], tanh_ratio(C(x, 1e-30)).slope.imag() / 1e-30, 1e-13) << x;
  }
}

}  // namespace
}  // namespace codesign
