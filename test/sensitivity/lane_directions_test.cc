// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/lane_directions.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace codesign {
namespace {

TEST(LaneDirections, AColumnIsOneComponentsDerivatives) {
  Directions<4> x(3);
  EXPECT_TRUE(x.isZero(0.0));
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(x.data()) % 64, 0U);
  for (int k = 0; k < 12; ++k) x.data()[k] = k;
  x.vector(1) += Lanes<4>::Vector{10.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(x(0, 1), 14.0);
  EXPECT_EQ(x.vector(2)[3], 11.0);
}

TEST(LaneDirections, CopiesHaveMemoryOfTheirOwn) {
  Directions<8> x(2);
  x.setConstant(3.0);
  Directions<8> y = x, z;
  x.setZero();
  EXPECT_EQ(y(7, 1), 3.0);
  z = y;
  EXPECT_EQ(z.cols(), 2);
  EXPECT_NE(z.data(), y.data());
  EXPECT_EQ(z(0, 0), 3.0);
}

}  // namespace
}  // namespace codesign
