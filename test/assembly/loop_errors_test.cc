// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(LoopErrors, AreTheGapOfTheLoop) {
  LoopsToClose c(triangle());
  Posture posture = c.at({0.0, 0.0});
  LoopErrors errors;
  EXPECT_NEAR(errors.find(c.loops, c.design, LoopRows::kAll, &posture), 1.2, 1e-15);
  EXPECT_EQ(posture.miss.owner, "tip");
  EXPECT_NEAR(posture.miss.length, 1.2, 1e-15);
  EXPECT_NEAR(size_of(posture.miss), 1.2, 1e-15);
  posture.theta << -std::asin(0.6), std::asin(0.6);
  EXPECT_LT(errors.find(c.loops, c.design, LoopRows::kAll, &posture), 1e-15);
  EXPECT_LT(size_of(posture.miss), 1e-15);
}

TEST(LoopErrors, OfADroppedRowCountInTheMissAlone) {
  ReactionSharing sharing;
  sharing.compliance = 1e-9;
  sharing.pairs = {2};
  sharing.dropped = {{2, -1, 0}};  // along x
  LoopsToClose c(triangle(), "{}", sharing);
  Posture posture = c.at({0.0, 0.0});
  LoopErrors errors;
  EXPECT_LT(errors.find(c.loops, c.design, LoopRows::kEnforced, &posture), 1e-15);
  EXPECT_NEAR(posture.miss.length, 1.2, 1e-15);
  EXPECT_NEAR(errors.find(c.loops, c.design, LoopRows::kAll, &posture), 1.2, 1e-15);
}

TEST(LoopErrors, ThatAreNotFiniteLeaveTheMiss) {
  LoopsToClose c(triangle());
  Posture posture = c.at({0.0, std::numeric_limits<double>::quiet_NaN()});
  posture.miss = {"before", 0.5, 0.0};
  LoopErrors errors;
  EXPECT_TRUE(std::isnan(errors.find(c.loops, c.design, LoopRows::kAll, &posture)));
  EXPECT_EQ(posture.miss.owner, "before");
}

}  // namespace
}  // namespace codesign
