// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/guess_text.h"

#include <gtest/gtest.h>

#include "assembly/loops_to_close.h"

namespace codesign {
namespace {

TEST(GuessText, NamesTheChosenJointsWithFourDigits) {
  LoopsToClose c(triangle());
  EXPECT_EQ(
      guess_text(c.compiled.system.robot(), c.loops.tree, Eigen::Vector2d(-0.643501, 1.0), {0, 1}),
      "left_hinge: {guess: -0.6435}, right_hinge: {guess: 1}");
  EXPECT_EQ(guess_text(c.compiled.system.robot(), c.loops.tree, Eigen::Vector2d(0.0, -1e-9), {1}),
            "right_hinge: {guess: 0}");
}

TEST(DesignText, NamesTheTunedParameters) {
  LoopsToClose c(
      triangle(), "{}", 1e-9,
      "duration: 1.0\nobjective: {integral: [{signal: left_hinge/velocity}]}\nparameters: {length: "
      "{tune: true}}\n");
  EXPECT_EQ(design_text(c.compiled.system.study(), {1.25}), "length = 1.25");
}

}  // namespace
}  // namespace codesign
