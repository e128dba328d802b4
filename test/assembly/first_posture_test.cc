// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/first_posture.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(FirstPosture, TakesPositionsThenGuessesThenZero) {
  LoopsToClose c(four_bar(),
                 "{left_hinge: {position: 0.6, velocity: 2.0}, left_pin: {guess: -0.4}}");
  const FirstPosture first(c.loops);
  Posture posture = c.at({9.0, 9.0, 9.0});
  first.set(c.design.parameters, &posture);
  EXPECT_EQ(posture.theta, Eigen::Vector3d(0.6, 0.0, -0.4));
  EXPECT_EQ(posture.rate, Eigen::Vector3d(2.0, 0.0, 0.0));
}

TEST(FirstPosture, OfAnotherBeginReplacesGuessesAndKeepsPositions) {
  LoopsToClose c(four_bar(), "{left_hinge: {position: 0.6}, left_pin: {guess: -0.4}}");
  FirstPosture first(c.loops);
  EXPECT_TRUE(first.is_own(c.design.parameters));
  first.begin_at(1.5, Eigen::Vector3d(0.1, 0.2, 0.3));
  first.nudge(Eigen::Vector3d(0.01, 0.01, 0.01));
  Posture posture = c.at({});
  first.set(c.design.parameters, &posture);
  EXPECT_EQ(first.time(), 1.5);
  EXPECT_EQ(posture.theta, Eigen::Vector3d(0.6, 0.2, 0.3));
  EXPECT_FALSE(first.is_own(c.design.parameters));
  first.begin_at(0.0, {});
  first.set(c.design.parameters, &posture);
  EXPECT_EQ(posture.theta, Eigen::Vector3d(0.6, 0.01, -0.39)) << "with the nudge";
}

TEST(FirstPosture, IsTheStudysOwnAtItsStartValuesOnly) {
  LoopsToClose c(triangle());
  const FirstPosture first(c.loops);
  EXPECT_TRUE(first.is_own({1.0}));
  EXPECT_FALSE(first.is_own({1.1}));
}

}  // namespace
}  // namespace codesign
