// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/value_program.h"

#include <gtest/gtest.h>

#include "codegen/traced.h"

namespace codesign {
namespace {

using Kind = ValueProgram::Kind;

class ValueProgramTest : public ::testing::Test {
 protected:
  Traced leaf(int k) { return {&recording, recording.leaf(0, k, true)}; }

  ValueProgram compile(const std::vector<Traced>& results) {
    for (std::size_t k = 0; k < results.size(); ++k)
      task.outputs.push_back({results[k].node(), {1, static_cast<int>(k)}});
    task.homes.resize(static_cast<std::size_t>(recording.size()));
    for (int n = 0; n < recording.size(); ++n)
      if (recording.node(n).operation == Operation::kLeaf)
        task.homes[static_cast<std::size_t>(n)] = {0, recording.node(n).b};
    return {recording, task};
  }

  static std::vector<Kind> kinds(const ValueProgram& program) {
    std::vector<Kind> list;
    for (const ValueProgram::Instruction& i : program.instructions) list.push_back(i.kind);
    return list;
  }

  Recording recording;
  ValueTask task;
};

TEST_F(ValueProgramTest, ProductsThatOneSumUsesArePartOfIt) {
  const Traced a = leaf(0), b = leaf(1), c = leaf(2);
  EXPECT_EQ(kinds(compile({a * b + c, a * c - b, c - b * b})),
            (std::vector<Kind>{Kind::kProductPlus, Kind::kProductMinus, Kind::kMinusProduct}));
}

TEST_F(ValueProgramTest, OfTwoProductsInASumOneIsPartOfIt) {
  const Traced a = leaf(0), b = leaf(1), c = leaf(2);
  const ValueProgram program = compile({a * b - a * c});
  EXPECT_EQ(kinds(program), (std::vector<Kind>{Kind::kOperation, Kind::kMinusProduct}));
  EXPECT_EQ(program.slots, 2);
}

TEST_F(ValueProgramTest, ProductsThatAreUsedTwiceOrAskedForAreComputedOnce) {
  const Traced a = leaf(0), b = leaf(1), c = leaf(2), product = a * b;
  EXPECT_EQ(kinds(compile({product + c, product - c})),
            (std::vector<Kind>{Kind::kOperation, Kind::kOperation, Kind::kOperation}));
}

TEST_F(ValueProgramTest, AnAskedForProductIsNotHidden) {
  const Traced a = leaf(0), product = a * leaf(1);
  task.kept = {product.node()};
  const ValueProgram program = compile({product + leaf(2)});
  EXPECT_EQ(kinds(program), (std::vector<Kind>{Kind::kOperation, Kind::kOperation}));
  EXPECT_GE(program.slot[static_cast<std::size_t>(product.node())], 0);
}

TEST_F(ValueProgramTest, WhatNoResultNeedsIsLeftOut) {
  const Traced a = leaf(0), b = leaf(1);
  sqrt(a / b);
  const ValueProgram program = compile({a - b});
  EXPECT_EQ(program.instructions.size(), 1u);
  EXPECT_EQ(program.stores[0], (std::vector<Place>{{1, 0}}));
}

TEST_F(ValueProgramTest, ResultsThatAreLeavesAreCopiedAndEqualOnesStoredTwice) {
  const Traced a = leaf(0), b = leaf(1);
  const ValueProgram program = compile({a, a + b, a + b});
  EXPECT_EQ(kinds(program), (std::vector<Kind>{Kind::kOperation, Kind::kCopy}));
  EXPECT_EQ(program.stores[0].size(), 2u);
}

TEST_F(ValueProgramTest, GuardsStandBehindWhatTheyCompareAndSlotsBehindReservedOnes) {
  const Traced a = leaf(0), b = leaf(1), sum = a + b;
  is_less(sum, a, true);
  is_less(a, b, false);
  task.guards = recording.guards();
  task.reserved_slots = 5;
  const ValueProgram program = compile({sum - a});
  EXPECT_EQ(kinds(program), (std::vector<Kind>{Kind::kGuardGreaterEqual, Kind::kOperation,
                                               Kind::kGuardLess, Kind::kOperation}));
  EXPECT_EQ(program.slot[static_cast<std::size_t>(sum.node())], 5);
  EXPECT_EQ(program.slots, 7);
}

}  // namespace
}  // namespace codesign
