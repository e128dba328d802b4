// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/gradient_cost.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

// Lanes are evaluated in groups of eight and four; the adjoint uses one lane of each group to check its plan.
TEST(GradientCost, GrowsByGroups) {
  EXPECT_EQ(direct_cost(1), direct_cost(4));
  EXPECT_LT(direct_cost(4), direct_cost(5));
  EXPECT_EQ(direct_cost(5), direct_cost(8));
  EXPECT_LT(direct_cost(8), direct_cost(9));
  EXPECT_EQ(adjoint_cost(1), adjoint_cost(3));
  EXPECT_EQ(adjoint_cost(4), adjoint_cost(7));
  EXPECT_LT(adjoint_cost(7), adjoint_cost(8));
}

TEST(GradientCost, TheAdjointHasToEarnItsWayBack) {
  EXPECT_LT(direct_cost(8), adjoint_cost(1));
  EXPECT_LT(adjoint_cost(8), direct_cost(64));
}

}  // namespace
}  // namespace codesign
