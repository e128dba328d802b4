// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/winding.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

WindingConstants<double> winding() {
  WindingConstants<double> c;
  c.resistance = 0.5;
  c.inductance = 0.01;
  c.torque_constant = 0.04;
  return c;
}

// 6 V at 100 rad/s: (6 - 4)/0.5 = 4 A; at 1 A the voltage of 1.5 V is left to the inductance.
TEST(Winding, ByHand) {
  EXPECT_DOUBLE_EQ(winding().steady_current(6.0, 100.0), 4.0);
  EXPECT_DOUBLE_EQ(winding().steady_current(-6.0, 0.0), -12.0) << "stall current";
  EXPECT_DOUBLE_EQ(winding().current_rate(6.0, 1.0, 100.0), 150.0);
  EXPECT_NEAR(winding().current_rate(6.0, 4.0, 100.0), 0.0, 1e-12) << "the steady current stays";
}

}  // namespace
}  // namespace codesign
