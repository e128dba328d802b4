// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/coupling_followers.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

/// Two hinges, the second of which turns by 0.3 rad and twice the angle of the first.
std::string coupled_hinges() {
  std::string second = hinge("second", "ground", "b", "1 0 0");
  second.insert(second.find("</joint>"), "<mimic joint='first' multiplier='2' offset='0.3'/>");
  return robot(bar("a") + bar("b") + hinge("first", "ground", "a", "0 0 0") + second);
}

TEST(CouplingFollowers, TakeWhatTheCouplingImplies) {
  LoopsToClose c(coupled_hinges());
  EXPECT_FALSE(c.loops.followers.follows(0));
  EXPECT_TRUE(c.loops.followers.follows(1));
  Posture posture = c.at({0.5, 0.0});
  posture.rate << 4.0, 0.0;
  c.loops.followers.follow(c.compiled.equations, &posture);
  EXPECT_NEAR(posture.theta[1], 1.3, 1e-15);
  EXPECT_NEAR(posture.rate[1], 8.0, 1e-15);
}

TEST(CouplingFollowers, KeepWhatIsGivenOrGuessed) {
  LoopsToClose c(coupled_hinges());
  for (const bool guessed : {false, true}) {
    Posture posture = c.at({0.5, 0.1});
    (guessed ? posture.given.guess : posture.given.position)[1] = true;
    posture.given.velocity[1] = true;
    c.loops.followers.follow(c.compiled.equations, &posture);
    EXPECT_EQ(posture.theta[1], 0.1);
    EXPECT_EQ(posture.rate[1], 0.0);
  }
}

TEST(CouplingFollowers, ArePreferredAsDependentCoordinates) {
  LoopsToClose c(coupled_hinges());
  ColumnPreferences lists;
  c.loops.followers.by_preference({false, false}, &lists);
  EXPECT_EQ(lists, (ColumnPreferences{{1}, {0}}));
  c.loops.followers.by_preference({false, true}, &lists);
  EXPECT_EQ(lists, (ColumnPreferences{{}, {0}}));
}

TEST(CouplingFollowers, WithoutAGivenMotionAreNotDriven) {
  LoopsToClose c(coupled_hinges());
  std::vector<bool> flags(2, false);
  c.loops.followers.mark_driven(&flags);
  EXPECT_EQ(flags, std::vector<bool>(2, false));
  EXPECT_EQ(c.loops.followers.given_motion(c.compiled.equations, 0, 1.0).value, 0.0);
}

}  // namespace
}  // namespace codesign
