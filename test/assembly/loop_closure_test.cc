// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_closure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(LoopClosure, ChangesTheCoordinatesThatTheLoopsDetermine) {
  LoopsToClose c(four_bar(), "{left_hinge: {position: 0.6}}");
  LoopClosure closure(c.loops);
  Posture posture = c.at({0.6, 0.5, -0.5});
  EXPECT_EQ(closure.close(c.design, &posture), Closure::kClosed);
  EXPECT_EQ(posture.theta[0], 0.6);
  EXPECT_NEAR(posture.theta[1], 0.6, 1e-12);
  EXPECT_EQ(posture.dependent, (std::vector<int>{1, 2}));
  EXPECT_EQ(posture.moved, posture.dependent);
  EXPECT_EQ(posture.rank_tolerance, Posture::kRank);
}

// In a line the loop determines one of the joints across it at most, and none along it.
TEST(LoopClosure, ThatFailsHasTriedAllCoordinatesAndTheFinerRank) {
  LoopsToClose c(stretched_bars());
  LoopClosure closure(c.loops);
  Posture posture = c.at({0.0, 0.0, 0.0});
  EXPECT_EQ(closure.dependent(c.design, posture, LoopRows::kAll, Posture::kRank).size(), 1U);
  EXPECT_EQ(closure.close(c.design, &posture), Closure::kApart);
  EXPECT_EQ(posture.moved, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(posture.rank_tolerance, Posture::kSingularRank);
  EXPECT_NEAR(posture.miss.length, 0.1, 1e-9);
}

TEST(LoopClosure, LeavesGivenPositionsOutOfTheDependentOnes) {
  LoopsToClose c(triangle(), "{left_hinge: {position: 0.3}}");
  LoopClosure closure(c.loops);
  EXPECT_EQ(closure.dependent(c.design, c.at({0.3, 0.4}), LoopRows::kAll, Posture::kRank),
            std::vector<int>{1});
}

}  // namespace
}  // namespace codesign
