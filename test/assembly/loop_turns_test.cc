// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_turns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/loops_to_close.h"
#include "integration/turning_loops.h"

namespace codesign {
namespace {

TEST(LoopTurns, AreTheSameInOneStrideAndInManySteps) {
  LoopsToClose c(turning_parallelogram());
  std::vector<LinkMotion<double>> links;
  const auto at = [&](double angle) { return c.at({angle, -angle, angle}); };
  State<double> begin;
  begin.resize(c.compiled.system.layout());
  place(c.loops, c.design, at(0.3), &links, &begin);
  c.compiled.equations.track_turns(&begin);
  for (const double way : {0.4, 7.0, -20.0}) {
    TurnFollower<double> follower(c.compiled.system);
    State<double> stride = begin, steps = begin;
    count_turns(c.loops, c.design, at(0.3).theta, at(0.3 + way), &follower, &stride);
    for (int k = 0; k < 50; ++k)
      count_turns(c.loops, c.design, at(0.3 + way * k / 50).theta, at(0.3 + way * (k + 1) / 50),
                  &follower, &steps);
    ASSERT_EQ(stride.turns.size(), steps.turns.size());
    for (std::size_t k = 0; k < steps.turns.size(); ++k)
      EXPECT_NEAR(stride.turns[k], steps.turns[k], 1e-9) << way << " " << k;
    EXPECT_EQ(stride.turns == begin.turns, std::abs(way) < 1e-9);
  }
}

TEST(LoopTurns, OfAnotherStateReplaceThoseOfLoopsAlone) {
  LoopsToClose c(turning_parallelogram());
  State<double> state;
  state.resize(c.compiled.system.layout());
  std::vector<double> turns(state.turns.size(), 7.0);
  keep_loop_turns(c.compiled.system, turns, &state);
  const int slot = c.compiled.system.layout().turn(3, 0);
  for (std::size_t k = 0; k < turns.size(); ++k)
    EXPECT_EQ(state.turns[k] == 7.0, static_cast<int>(k) == slot) << k;
}

}  // namespace
}  // namespace codesign
