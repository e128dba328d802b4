// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/tangent_program.h"

#include <gtest/gtest.h>

#include "codegen/some_recording.h"
#include "codegen/traced.h"

namespace codesign {
namespace {

/// The derivatives of the outputs along one direction of the leaves.
std::vector<double> run(const Recording& recording, const TangentProgram& program, std::size_t outputs, const std::vector<double>& leaves,
                        const std::vector<double>& direction) {
  const std::vector<double> values = node_values(recording, leaves);
  std::vector<double> rows(static_cast<std::size_t>(recording.size())), result(outputs);
  for (int n = 0; n < recording.size(); ++n)
    if (recording.node(n).operation == Operation::kLeaf)
      rows[static_cast<std::size_t>(n)] = direction[static_cast<std::size_t>(recording.node(n).b)];
  for (const TangentProgram::Sum& sum : program.sums) {
    double total = 0.0;
    for (const TangentProgram::Term& term : sum.terms) {
      const double product =
          rows[static_cast<std::size_t>(term.row)] * (term.factor < 0 ? 1.0 : values[static_cast<std::size_t>(term.factor)]);
      total += term.added ? product : -product;
    }
    (sum.node < 0 ? result[static_cast<std::size_t>(sum.output.place.index)] : rows[static_cast<std::size_t>(sum.node)]) = total;
  }
  return result;
}

std::vector<bool> leaves_of(const Recording& recording) {
  std::vector<bool> is_leaf;
  for (int n = 0; n < recording.size(); ++n) is_leaf.push_back(recording.node(n).operation == Operation::kLeaf);
  return is_leaf;
}

TEST(TangentProgram, IsTheDerivativeThatLanesGive) {
  SomeRecording some;
  std::vector<ValueTask::Output> outputs;
  for (int k = 0; k < kSomeResults; ++k) outputs.push_back({some.results[static_cast<std::size_t>(k)], {0, k}});
  const TangentProgram program(&some.recording, outputs, leaves_of(some.recording));
  const std::vector<double> leaves = SomeRecording::leaf_values();
  std::vector<double> direction;
  std::vector<Lanes<4>> lanes(leaves.begin(), leaves.end());
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    direction.push_back(std::cos(2.1 * static_cast<double>(k)));
    lanes[k].v[0] = direction[k];
  }
  const std::vector<double> actual = run(some.recording, program, outputs.size(), leaves, direction);
  const std::vector<Lanes<4>> expected = some_results(lanes);
  for (std::size_t k = 0; k < actual.size(); ++k) EXPECT_NEAR(actual[k], expected[k].v[0], 1e-12 * (1.0 + std::abs(expected[k].v[0]))) << k;
}

class SmallTangents : public ::testing::Test {
 protected:
  Recording recording;
  const Traced x{&recording, recording.leaf(0, 0, true)}, y{&recording, recording.leaf(0, 1, true)},
      z{&recording, recording.leaf(0, 2, true)};

  TangentProgram differentiate(const Traced& result) { return {&recording, {{result.node_in(&recording), {0, 0}}}, leaves_of(recording)}; }
};

TEST_F(SmallTangents, OfSumsOfProductsAreOneSum) {
  const TangentProgram program = differentiate(x * y + y * z - x * z);
  ASSERT_EQ(program.sums.size(), 1u);
  EXPECT_EQ(program.sums[0].terms.size(), 3u) << "one for each leaf, factors added up beforehand";
  EXPECT_EQ(program.rows, 0);
}

TEST_F(SmallTangents, OfFunctionsOfOneNumberNeedNoSumOfTheirOwn) {
  const TangentProgram program = differentiate(exp(sin(tanh(x))));
  ASSERT_EQ(program.sums.size(), 1u);
  EXPECT_EQ(program.sums[0].terms.size(), 1u);
}

TEST_F(SmallTangents, WhatIsUsedTwiceIsDifferentiatedOnce) {
  const Traced product = x * y;
  const TangentProgram program = differentiate(sin(product) * cos(product) * z);
  EXPECT_EQ(program.rows, 1);
}

TEST_F(SmallTangents, OfAConstantAndOfARoundedNumberAreEmpty) {
  EXPECT_TRUE(differentiate(Traced(3.0)).sums[0].terms.empty());
  EXPECT_TRUE(differentiate(round(x)).sums[0].terms.empty());
}

TEST_F(SmallTangents, AWrongDerivativeWouldBeSeen) {
  // The check above must fail for a program with a wrong first factor.
  TangentProgram program = differentiate(x * y);
  const std::vector<double> leaves{2.0, 3.0, 0.0}, direction{1.0, 1.0, 0.0};
  EXPECT_DOUBLE_EQ(run(recording, program, 1, leaves, direction)[0], 5.0);
  program.sums[0].terms[0].added = false;
  EXPECT_NE(run(recording, program, 1, leaves, direction)[0], 5.0);
}

}  // namespace
}  // namespace codesign
