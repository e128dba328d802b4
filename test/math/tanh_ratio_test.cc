// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/tanh_ratio.h"

#include <gtest/gtest.h>

#include <complex>

namespace codesign {
namespace {

/// The derivative, by the complex step.
double slope(double x) { return tanh_ratio(std::complex<double>(x, 1e-30)).imag() / 1e-30; }

TEST(TanhRatio, IsWhatItSays) {
  EXPECT_EQ(tanh_ratio(0.0), 1.0);
  EXPECT_NEAR(slope(0.0), -1.0 / 3.0, 1e-16);
  for (double x : {1e-4, 0.01, 0.0499, 0.0501, 1.0, 400.0}) {
    EXPECT_NEAR(tanh_ratio(x), std::tanh(std::sqrt(x)) / std::sqrt(x), 4e-16) << x;
  }
}

TEST(TanhRatio, IsSmoothWhereTheSeriesEnds) {
  EXPECT_NEAR(tanh_ratio(0.05 - 1e-16), tanh_ratio(0.05), 1e-14);
  EXPECT_NEAR(slope(0.05 - 1e-16), slope(0.05), 1e-14);
}

TEST(TanhRatio, ItsLanesAreDerivatives) {
  for (double x : {0.0, 1e-6, 0.03, 0.0499, 0.0501, 0.7, 16.0, 1600.0}) {
    Lanes<4> lane(x);
    lane.v[2] = 1.0;
    EXPECT_NEAR(tanh_ratio(lane).v[2], slope(x), 1e-14) << x;
  }
}

}  // namespace
}  // namespace codesign
