// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <complex>

#include "codegen/derivatives.h"
#include "codegen/some_recording.h"
#include "codegen/traced.h"
#include "math/differences.h"

namespace codesign {
namespace {

constexpr int kWeights = 1;  // the array of the weights

double value_of_node(const Traced& x, const std::vector<double>& values) {
  return x.is_literal() ? x.value() : values[static_cast<std::size_t>(x.node())];
}

std::vector<bool> targets(const Recording& recording, const std::vector<int>& nodes) {
  std::vector<bool> is_target(static_cast<std::size_t>(recording.size()));
  for (int n : nodes) is_target[static_cast<std::size_t>(n)] = true;
  return is_target;
}

TEST(Adjoints, OfGeneratedFormulasAreTheTransposedComplexStep) {
  SomeRecording some;
  std::vector<int> leaves;
  for (int k = 0; k < kSomeLeaves; ++k) leaves.push_back(some.recording.leaf(0, k, true));
  const std::vector<bool> is_target = targets(some.recording, leaves);
  std::vector<AdjointSeed> seeds;
  // The leaves of weights follow those of the state, so that node_values() finds both in one array.
  for (int k = 0; k < kSomeResults; ++k)
    seeds.push_back({some.results[static_cast<std::size_t>(k)],
                     Traced(&some.recording, some.recording.leaf(0, kSomeLeaves + k, true))});
  const std::vector<Traced> adjoints = derive_adjoints(&some.recording, seeds, is_target);

  const std::vector<double> at = SomeRecording::leaf_values();
  Eigen::VectorXd weights(kSomeResults);
  for (int k = 0; k < kSomeResults; ++k) weights[k] = std::cos(0.7 * k + 0.1);
  std::vector<double> inputs = at;
  inputs.insert(inputs.end(), weights.begin(), weights.end());
  const std::vector<double> values = node_values(some.recording, inputs);
  Eigen::MatrixXd derived(1, kSomeLeaves);
  for (int k = 0; k < kSomeLeaves; ++k)
    derived(0, k) = value_of_node(
        adjoints[static_cast<std::size_t>(leaves[static_cast<std::size_t>(k)])], values);
  const Eigen::MatrixXd reference = complex_step_jacobian(
      [&](const Eigen::VectorXcd& x) {
        const std::vector<std::complex<double>> results =
            some_results(std::vector<std::complex<double>>(x.begin(), x.end()));
        Eigen::VectorXcd sum(1);
        sum[0] = Eigen::Map<const Eigen::VectorXcd>(results.data(), kSomeResults)
                     .cwiseProduct(weights.cast<std::complex<double>>())
                     .sum();
        return sum;
      },
      Eigen::Map<const Eigen::VectorXd>(at.data(), kSomeLeaves));
  EXPECT_GT(reference.norm(), 1.0);
  EXPECT_LT(compare_jacobians(derived, reference).largest, 1e-12);
}

/// x only through y = sin x, which is a target: the derivative by x is the one at fixed y.
TEST(Adjoints, NothingPassesThroughATarget) {
  Recording recording;
  const Traced x(&recording, recording.leaf(0, 0, true)),
      y = sin(x), z = x * y + y, weight(&recording, recording.leaf(0, 1, true));
  const std::vector<Traced> adjoints =
      derive_adjoints(&recording, {{z.node(), weight}}, targets(recording, {x.node(), y.node()}));
  const std::vector<double> values = node_values(recording, {0.3, 2.0});
  EXPECT_DOUBLE_EQ(value_of_node(adjoints[static_cast<std::size_t>(x.node())], values),
                   2.0 * std::sin(0.3));
  EXPECT_DOUBLE_EQ(value_of_node(adjoints[static_cast<std::size_t>(y.node())], values), 2.0 * 1.3);
}

TEST(Adjoints, OfATargetThatIsAnOutputAreItsWeights) {
  Recording recording;
  const Traced x(&recording, recording.leaf(0, 0, true)), y(&recording, recording.leaf(0, 1, true)),
      weight(&recording, recording.leaf(kWeights, 0, true));
  const std::vector<Traced> adjoints =
      derive_adjoints(&recording, {{x.node(), weight}, {x.node(), weight}, {y.node(), 3.0}},
                      targets(recording, {x.node(), y.node()}));
  EXPECT_EQ(adjoints[static_cast<std::size_t>(x.node())].node(), (weight + weight).node());
  EXPECT_EQ(adjoints[static_cast<std::size_t>(y.node())].value(), 3.0);
}

/// Only the nodes between targets and outputs get adjoints: none for what no target enters, none
/// for other leaves.
TEST(Adjoints, OfNodesThatNoTargetEntersAreZeroAndRecordNothing) {
  Recording recording;
  const Traced x(&recording, recording.leaf(0, 0, true)), y(&recording, recording.leaf(0, 1, true)),
      z = sin(y) * exp(y);
  const std::vector<bool> is_target = targets(recording, {x.node()});
  const int before = recording.size();
  const std::vector<Traced> adjoints = derive_adjoints(&recording, {{z.node(), 1.0}}, is_target);
  EXPECT_EQ(recording.size(), before);
  for (const Traced& adjoint : adjoints)
    EXPECT_TRUE(adjoint.is_literal() && adjoint.value() == 0.0);
}

class JacobianTest : public ::testing::TestWithParam<EliminationOrder> {};

TEST_P(JacobianTest, OfGeneratedFormulasEqualsTheComplexStep) {
  SomeRecording some;
  std::vector<JacobianInput> inputs;
  for (int k = 0; k < kSomeLeaves; ++k) inputs.push_back({some.recording.leaf(0, k, true), k, 1.0});
  const std::vector<JacobianEntry> entries =
      derive_jacobian(&some.recording, some.results, inputs, GetParam());

  const std::vector<double> leaves = SomeRecording::leaf_values(),
                            values = node_values(some.recording, leaves);
  Eigen::MatrixXd derived = Eigen::MatrixXd::Zero(kSomeResults, kSomeLeaves);
  for (const JacobianEntry& entry : entries) {
    EXPECT_EQ(derived(entry.row, entry.column), 0.0) << "an entry stands twice";
    derived(entry.row, entry.column) = entry.value.is_literal()
                                           ? entry.value.value()
                                           : values[static_cast<std::size_t>(entry.value.node())];
  }
  const Eigen::MatrixXd reference = complex_step_jacobian(
      [](const Eigen::VectorXcd& x) {
        const std::vector<std::complex<double>> results =
            some_results(std::vector<std::complex<double>>(x.begin(), x.end()));
        return Eigen::VectorXcd(Eigen::Map<const Eigen::VectorXcd>(results.data(), kSomeResults));
      },
      Eigen::Map<const Eigen::VectorXd>(leaves.data(), kSomeLeaves));
  EXPECT_LT(compare_jacobians(derived, reference).largest, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Orders, JacobianTest,
                         ::testing::Values(EliminationOrder::kForward, EliminationOrder::kReverse,
                                           EliminationOrder::kMarkowitz));

TEST(Jacobian, LinearOutputsHaveLiteralsAndNoOtherEntries) {
  Recording recording;
  const Traced x(&recording, recording.leaf(0, 0, true)), y(&recording, recording.leaf(0, 1, true)),
      z = 2.0 * x - y;
  const std::vector<JacobianEntry> entries = derive_jacobian(
      &recording, {z.node_in(&recording), y.node()}, {{x.node(), 0, 1.0}, {y.node(), 1, 1.0}});
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].value.value(), 2.0);
  EXPECT_EQ(entries[1].value.value(), -1.0);
  EXPECT_EQ(entries[2].value.value(), 1.0);
  for (const JacobianEntry& entry : entries) EXPECT_TRUE(entry.value.is_literal());
}

/// Leaves that depend on the same variable make one column.
TEST(Jacobian, LeavesOfOneColumnAddUp) {
  Recording recording;
  const Traced f(&recording, recording.leaf(0, 0, true)), g(&recording, recording.leaf(0, 1, true)),
      h = f * g;
  const std::vector<JacobianEntry> entries =
      derive_jacobian(&recording, {h.node()}, {{f.node(), 0, 3.0}, {g.node(), 0, 5.0}});
  ASSERT_EQ(entries.size(), 1U);
  const std::vector<double> values = node_values(recording, {7.0, 11.0});
  EXPECT_EQ(values[static_cast<std::size_t>(entries[0].value.node())], 3.0 * 11.0 + 5.0 * 7.0);
}

/// Factors that do not vary are multiplied with each other, so that one product per evaluation
/// remains.
TEST(Jacobian, FactorsOfTheDesignAreMultipliedFirst) {
  Recording recording;
  const Traced m(&recording, recording.leaf(1, 0, false)),
      n(&recording, recording.leaf(1, 1, false)), x(&recording, recording.leaf(0, 0, true));
  const Traced y = m * sin(n * x);
  const std::vector<JacobianEntry> entries =
      derive_jacobian(&recording, {y.node()}, {{x.node(), 0, 1.0}});
  ASSERT_EQ(entries.size(), 1U);
  const Recording::Node product = recording.node(entries[0].value.node());
  ASSERT_EQ(product.operation, Operation::kMultiply);
  EXPECT_NE(recording.node(product.a).varies, recording.node(product.b).varies);
}

/// The derivatives of the outputs along one direction of the leaves.
std::vector<double> run(const Recording& recording, const TangentProgram& program,
                        std::size_t outputs, const std::vector<double>& leaves,
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
          rows[static_cast<std::size_t>(term.row)] *
          (term.factor < 0 ? 1.0 : values[static_cast<std::size_t>(term.factor)]);
      total += term.added ? product : -product;
    }
    (sum.node < 0 ? result[static_cast<std::size_t>(sum.output.place.index)]
                  : rows[static_cast<std::size_t>(sum.node)]) = total;
  }
  return result;
}

std::vector<bool> leaves_of(const Recording& recording) {
  std::vector<bool> is_leaf;
  for (int n = 0; n < recording.size(); ++n)
    is_leaf.push_back(recording.node(n).operation == Operation::kLeaf);
  return is_leaf;
}

TEST(TangentProgram, IsTheDerivativeThatLanesGive) {
  SomeRecording some;
  std::vector<ValueTask::Output> outputs;
  for (int k = 0; k < kSomeResults; ++k)
    outputs.push_back({some.results[static_cast<std::size_t>(k)], {0, k}});
  const TangentProgram program(&some.recording, outputs, leaves_of(some.recording));
  const std::vector<double> leaves = SomeRecording::leaf_values();
  std::vector<double> direction;
  std::vector<Lanes<4>> lanes(leaves.begin(), leaves.end());
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    direction.push_back(std::cos(2.1 * static_cast<double>(k)));
    lanes[k].v[0] = direction[k];
  }
  const std::vector<double> actual =
      run(some.recording, program, outputs.size(), leaves, direction);
  const std::vector<Lanes<4>> expected = some_results(lanes);
  for (std::size_t k = 0; k < actual.size(); ++k)
    EXPECT_NEAR(actual[k], expected[k].v[0], 1e-12 * (1.0 + std::abs(expected[k].v[0]))) << k;
}

class SmallTangents : public ::testing::Test {
 protected:
  Recording recording;
  const Traced x{&recording, recording.leaf(0, 0, true)}, y{&recording, recording.leaf(0, 1, true)},
      z{&recording, recording.leaf(0, 2, true)};

  TangentProgram differentiate(const Traced& result) {
    return {&recording, {{result.node_in(&recording), {0, 0}}}, leaves_of(recording)};
  }
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
