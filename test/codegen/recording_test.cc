// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "codegen/recording.h"
#include "math/arrays.h"

namespace codesign {
namespace {

TEST(SourceId, GivesTheObjectBackAsItsOwnTypeOnly) {
  struct Holder {
    int first = 3;
  } holder;
  const SourceId id(holder);
  ASSERT_NE(id.as<Holder>(), nullptr);
  EXPECT_EQ(id.as<Holder>()->first, 3);
  EXPECT_EQ(id.as<int>(), nullptr);
  EXPECT_TRUE(id == SourceId(holder));
  EXPECT_FALSE(id == SourceId(holder.first)) << "the same address, but another type";
}

TEST(Recording, EveryLeafLiteralAndOperationIsThereOnce) {
  Recording r;
  const int x = r.leaf(0, 3, true), y = r.leaf(1, 3, false);
  EXPECT_NE(x, y);
  EXPECT_EQ(r.leaf(0, 3, true), x);
  EXPECT_EQ(r.literal(0.1), r.literal(0.1));
  EXPECT_NE(r.literal(0.0), r.literal(-0.0)) << "one over each differs";
  const int sum = r.operate(Operation::kAdd, x, y),
            difference = r.operate(Operation::kSubtract, x, y);
  EXPECT_EQ(r.operate(Operation::kAdd, y, x), sum) << "the order of a sum's parts does not count";
  EXPECT_NE(r.operate(Operation::kSubtract, y, x), difference);
  EXPECT_EQ(r.operate(Operation::kSin, sum), r.operate(Operation::kSin, sum));
  EXPECT_NE(r.operate(Operation::kSin, sum), r.operate(Operation::kCos, sum));
}

TEST(Recording, FindsWhatItHoldsAlsoAfterItHasGrown) {
  constexpr int kCount = 20000;
  Recording r;
  const auto record = [&r](int k) {
    const int x = r.leaf(k % 3, k, true), number = r.literal(std::ldexp(1.0, k % 64) * k);
    return std::array<int, 3>{x, number, r.operate(Operation::kMultiply, x, number)};
  };
  std::vector<std::array<int, 3>> nodes;
  for (int k = 0; k < kCount; ++k) nodes.push_back(record(k));
  const int size = r.size();
  for (int k = 0; k < kCount; ++k) EXPECT_EQ(record(k), nodes[to_index(k)]);
  EXPECT_EQ(r.size(), size);
  EXPECT_GT(size, 2 * kCount);
}

TEST(Recording, WhatDependsOnAVaryingLeafVaries) {
  Recording r;
  const int x = r.leaf(0, 0, true), design = r.leaf(1, 0, false), two = r.literal(2.0);
  EXPECT_FALSE(r.node(r.operate(Operation::kMultiply, design, two)).varies);
  EXPECT_TRUE(r.node(r.operate(Operation::kMultiply, design, x)).varies);
  EXPECT_TRUE(r.node(r.operate(Operation::kExp, x)).varies);
}

TEST(Recording, OriginsAreNumberedAsTheyCome) {
  Recording r;
  const int a = 0, b = 0;
  const int from_b = r.supplied(SourceId(b)), from_a = r.supplied(SourceId(a));
  EXPECT_EQ(r.supplied(SourceId(b)), from_b);
  EXPECT_EQ(r.node(from_a).b, 1);
  EXPECT_FALSE(r.node(from_a).varies);
  EXPECT_EQ(r.supplied_sources(), (std::vector<SourceId>{SourceId(b), SourceId(a)}));
  r.timed(SourceId(a), 0);
  const int rate = r.timed(SourceId(b), 2);
  EXPECT_EQ(r.node(rate).b, Recording::kFunctionOrders + 2);
  EXPECT_TRUE(r.node(rate).varies);
}

TEST(Recording, RemembersDecisions) {
  Recording r;
  EXPECT_FALSE(r.refused());
  EXPECT_TRUE(r.decide(1, 2, true, 10));
  EXPECT_TRUE(r.decide(1, 2, false, 11)) << "as it was decided before";
  ASSERT_EQ(r.guards().size(), 1u);
  EXPECT_TRUE(r.guards()[0].outcome);
  r.refuse();
  EXPECT_TRUE(r.refused());
}

TEST(Recording, FollowsOutcomes) {
  Recording r;
  r.follow({false, true});
  EXPECT_FALSE(r.decide(1, 2, true, 10));
  EXPECT_TRUE(r.decide(2, 3, false, 10));
  EXPECT_TRUE(r.decide(3, 4, true, 12)) << "as expected, since no more outcomes are given";
  EXPECT_EQ(r.guards()[2].decision, 2);
}

TEST(Recording, HoldsTheOutcomesOfSwitches) {
  Recording r;
  const int x = r.leaf(0, 0, true), y = r.leaf(0, 1, true), z = r.leaf(0, 2, true),
            design = r.leaf(0, 3, false), other = r.leaf(0, 4, false);
  r.follow({true, false});
  r.hold({false});
  EXPECT_TRUE(r.decide(z, x, true, 9, DecisionKind::kSwitch)) << "switches are not recorded yet";
  r.record_switches(true);
  EXPECT_FALSE(r.decide(x, y, true, 10, DecisionKind::kSwitch)) << "held";
  EXPECT_TRUE(r.decide(y, z, true, 11, DecisionKind::kSwitch))
      << "the mode is at its end: as expected";
  EXPECT_FALSE(r.decide(design, other, false, 12, DecisionKind::kSwitch));
  EXPECT_FALSE(r.guards()[0].is_switch);
  EXPECT_TRUE(r.guards()[1].is_switch);
  EXPECT_TRUE(r.guards()[2].is_switch);
  EXPECT_FALSE(r.guards()[3].is_switch) << "no state changes it";
}

TEST(Recording, AKinkOfOneFormulaMayBeAJumpOfAnother) {
  Recording r;
  const int x = r.leaf(0, 0, true), y = r.leaf(0, 1, true), z = r.leaf(0, 2, true);
  r.record_switches(true);
  r.decide(z, x, true, 9, DecisionKind::kSwitch);
  r.decide(x, y, true, 10, DecisionKind::kKink);
  r.decide(y, z, true, 11, DecisionKind::kKink);
  EXPECT_FALSE(r.switch_origins()[0].is_kink);
  EXPECT_TRUE(r.switch_origins()[1].is_kink);
  r.decide(x, y, true, 12, DecisionKind::kSwitch);
  EXPECT_FALSE(r.switch_origins()[1].is_kink);
  EXPECT_TRUE(r.switch_origins()[2].is_kink);
}

TEST(Recording, NotesExpressionsThatVary) {
  Recording r;
  const int x = r.leaf(0, 0, true), design = r.leaf(0, 1, false);
  r.note(x);
  EXPECT_TRUE(r.noted().empty());
  r.record_switches(true);
  for (const int node : {x, design, x}) r.note(node);
  EXPECT_EQ(r.noted(), std::vector<int>{x});
}

TEST(Recording, TurnsDecisionsByTheirPlace) {
  Recording r;
  r.turn([](unsigned place) { return place == 10; });
  EXPECT_FALSE(r.decide(1, 2, true, 10));
  EXPECT_TRUE(r.decide(2, 3, false, 10));
  EXPECT_TRUE(r.decide(3, 4, true, 12));
  EXPECT_EQ(r.places(), (std::vector<unsigned>{10, 12}));
}

}  // namespace

}  // namespace codesign
