// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/traced.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/scalar.h"

namespace codesign {
namespace {

class TracedTest : public ::testing::Test {
 protected:
  Recording recording;
  const Traced x{&recording, recording.leaf(0, 0, true)}, y{&recording, recording.leaf(0, 1, true)};

  const Recording::Node& node(const Traced& of) const { return recording.node(of.node()); }
};

TEST_F(TracedTest, KnownNumbersAreComputedWith) {
  const Traced known =
      (Traced(3.0) * 4.0 - 2.0) / 5.0 + sqrt(Traced(4.0)) + atan2(Traced(0.0), Traced(1.0));
  ASSERT_TRUE(known.is_literal());
  EXPECT_DOUBLE_EQ(known.value(), 4.0);
  for (const auto& [traced, expected] :
       {std::pair(sin(Traced(0.3)), std::sin(0.3)), std::pair(cos(Traced(0.3)), std::cos(0.3)),
        std::pair(asin(Traced(0.3)), std::asin(0.3)), std::pair(tanh(Traced(0.3)), std::tanh(0.3)),
        std::pair(exp(Traced(0.3)), std::exp(0.3)), std::pair(log(Traced(0.3)), std::log(0.3)),
        std::pair(round(Traced(0.7)), 1.0)})
    EXPECT_EQ(traced.value(), expected);
  EXPECT_EQ(recording.size(), 2) << "nothing was recorded";
}

TEST_F(TracedTest, NeutralElementsLeaveNothingBehind) {
  for (const Traced& same : {x + 0.0, 0.0 + x, x - 0.0, 1.0 * x, x * 1.0, x / 1.0, -(-x), +x})
    EXPECT_EQ(same.node(), x.node());
  for (const Traced& zero : {0.0 * x, x * 0.0, 0.0 / x, x - x}) {
    ASSERT_TRUE(zero.is_literal());
    EXPECT_EQ(zero.value(), 0.0);
  }
}

TEST_F(TracedTest, SignsMoveOutOfProductsAndIntoSums) {
  EXPECT_EQ(node(x * -2.0).operation, Operation::kNegate);
  EXPECT_EQ(node((-x) * y).operation, Operation::kNegate);
  EXPECT_EQ(((-x) * (-y)).node(), (x * y).node());
  EXPECT_EQ((x + (-y)).node(), (x - y).node());
  EXPECT_EQ(((-x) + y).node(), (y - x).node());
  EXPECT_EQ((x - (-y)).node(), (x + y).node());
  EXPECT_EQ(node(0.0 - x).operation, Operation::kNegate);
}

TEST_F(TracedTest, DivisionByANumberIsAProduct) {
  EXPECT_EQ((x / 4.0).node(), (0.25 * x).node());
  EXPECT_EQ(node(x / y).operation, Operation::kDivide);
}

TEST_F(TracedTest, AssigningOperatorsAreTheOthers) {
  Traced z = x;
  z += y;
  EXPECT_EQ(z.node(), (x + y).node());
  z *= x;
  z -= y;
  z /= x;
  EXPECT_EQ(z.node(), (((x + y) * x - y) / x).node());
}

TEST_F(TracedTest, DecisionsAreGuardedByTheLikelyOutcome) {
  EXPECT_TRUE(is_less(Traced(1.0), Traced(2.0), false)) << "known";
  EXPECT_TRUE(recording.guards().empty());
  EXPECT_TRUE(is_less(x, y, true));
  EXPECT_FALSE(is_less(x, Traced(2.0), false));
  ASSERT_EQ(recording.guards().size(), 2u);
  EXPECT_EQ(recording.guards()[0].a, x.node());
  EXPECT_TRUE(recording.guards()[0].outcome);
  EXPECT_FALSE(recording.guards()[1].outcome);
  EXPECT_FALSE(recording.refused());
}

TEST_F(TracedTest, WhatDoesNotVaryIsDecidedAsItIsAtTheDesign) {
  const Traced a(&recording, recording.leaf(1, 0, false), 3.0),
      b(&recording, recording.leaf(1, 1, false), 0.5);
  EXPECT_DOUBLE_EQ((sqrt(a * b + 1.0) - a / b).value(), std::sqrt(2.5) - 6.0);
  EXPECT_DOUBLE_EQ((-(-a) + atan2(-b, a)).value(), 3.0 + std::atan2(-0.5, 3.0));
  EXPECT_TRUE(is_less(b, a, false));
  EXPECT_FALSE(is_less(a * b, b, true));
  ASSERT_EQ(recording.guards().size(), 2u);
  EXPECT_TRUE(recording.guards()[0].outcome);
  EXPECT_FALSE(recording.guards()[1].outcome);
}

TEST_F(TracedTest, AValueThatIsNotKnownRefusesTheRecording) {
  EXPECT_EQ(value_of(Traced(3.0)), 3.0);
  EXPECT_FALSE(recording.refused());
  value_of(x);
  EXPECT_TRUE(recording.refused());
}

/// The outcomes of decisions by which a number is found in a recording that a state at x makes.
double whole_below_at(double at) {
  std::vector<bool> outcomes;
  for (;;) {
    Recording recording;
    recording.follow(outcomes);
    const Traced found = whole_below(Traced(&recording, recording.leaf(0, 0, true)));
    const auto wrong = [&](const Recording::Guard& guard) {
      return (at < recording.node(guard.b).literal) != guard.outcome;
    };
    const auto& guards = recording.guards();
    const auto first = std::find_if(guards.begin(), guards.end(), wrong);
    if (first == guards.end()) return found.value();
    outcomes.clear();
    for (auto guard = guards.begin(); guard <= first; ++guard) outcomes.push_back(guard->outcome);
    outcomes.back() = !outcomes.back();
  }
}

TEST_F(TracedTest, WholeNumbersAreLiteralsFoundByDecisions) {
  EXPECT_EQ(whole_below(Traced(-2.5)).value(), -3.0);
  for (double at : {0.0, 0.4, 1.0, 1.9, 2.0, 3.5, 17.3, 1024.0, -0.2, -1.0, -1.5, -2.0, -77.7})
    EXPECT_EQ(whole_below_at(at), std::floor(at)) << at;
}

TEST_F(TracedTest, TurnsAreCountedByRounding) {
  const Traced turns = nearest_turns(x, y);
  EXPECT_EQ(node(turns).operation, Operation::kMultiply);
  EXPECT_FALSE(recording.refused());
}

}  // namespace
}  // namespace codesign
