// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/brown_mcphee.h"

#include <gtest/gtest.h>

#include <complex>

namespace codesign {
namespace {

constexpr double kMuS = 0.4, kMuD = 0.3, kVt = 0.01;

TEST(BrownMcPhee, HandComputedPoints) {
  // At v = v_t: d = 1, S = mu_d tanh 4 + (mu_s - mu_d).
  EXPECT_NEAR(brown_mcphee(kVt, kMuS, kMuD, kVt), kMuD * std::tanh(4.0) + 0.1, 1e-16);
  // At v = 2 v_t: d = 7/4, S = mu_d tanh 8 + 0.1 * 2 * 16/49.
  EXPECT_NEAR(brown_mcphee(2.0 * kVt, kMuS, kMuD, kVt), kMuD * std::tanh(8.0) + 0.1 * 2.0 * 16.0 / 49.0, 1e-15);
  // At rest S = 0 and S' = (4 mu_d + 16/9 (mu_s - mu_d)) / v_t.
  EXPECT_EQ(brown_mcphee(0.0, kMuS, kMuD, kVt), 0.0);
  using C = std::complex<double>;
  EXPECT_NEAR(brown_mcphee(C(0.0, 1e-30), C(kMuS), C(kMuD), C(kVt)).imag() / 1e-30, (4.0 * kMuD + 16.0 / 9.0 * 0.1) / kVt, 1e-12);
}

TEST(BrownMcPhee, IsOddAndSettlesAtTheDynamicCoefficient) {
  EXPECT_EQ(brown_mcphee(-0.003, kMuS, kMuD, kVt), -brown_mcphee(0.003, kMuS, kMuD, kVt));
  EXPECT_NEAR(brown_mcphee(10.0, kMuS, kMuD, kVt), kMuD, 1e-8);
}

}  // namespace
}  // namespace codesign
