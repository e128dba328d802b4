// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_cost.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

// Lanes are evaluated in groups of eight and four.
TEST(GradientCost, GrowsByGroups) {
  EXPECT_EQ(direct_cost(1), direct_cost(4));
  EXPECT_LT(direct_cost(4), direct_cost(5));
  EXPECT_EQ(direct_cost(5), direct_cost(8));
  EXPECT_LT(direct_cost(8), direct_cost(9));
}

TEST(GradientCost, TheAdjointHasToEarnItsWayBack) {
  EXPECT_LT(direct_cost(8), kAdjointCost);
  EXPECT_LT(kAdjointCost, direct_cost(16));
}

}  // namespace
}  // namespace codesign
