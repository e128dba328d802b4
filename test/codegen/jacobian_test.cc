// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/jacobian.h"

#include <gtest/gtest.h>

#include <complex>

#include "codegen/some_recording.h"
#include "math/derivative_check.h"

namespace codesign {
namespace {

class JacobianTest : public ::testing::TestWithParam<EliminationOrder> {};

TEST_P(JacobianTest, OfGeneratedFormulasEqualsTheComplexStep) {
  SomeRecording some;
  std::vector<JacobianInput> inputs;
  for (int k = 0; k < kSomeLeaves; ++k) inputs.push_back({some.recording.leaf(0, k, true), k, 1.0});
  const std::vector<JacobianEntry> entries = derive_jacobian(&some.recording, some.results, inputs, GetParam());

  const std::vector<double> leaves = SomeRecording::leaf_values(), values = node_values(some.recording, leaves);
  Eigen::MatrixXd derived = Eigen::MatrixXd::Zero(kSomeResults, kSomeLeaves);
  for (const JacobianEntry& entry : entries) {
    EXPECT_EQ(derived(entry.row, entry.column), 0.0) << "an entry stands twice";
    derived(entry.row, entry.column) =
        entry.value.is_literal() ? entry.value.value() : values[static_cast<std::size_t>(entry.value.node())];
  }
  const Eigen::MatrixXd reference = complex_step_jacobian(
      [](const Eigen::VectorXcd& x) {
        const std::vector<std::complex<double>> results = some_results(std::vector<std::complex<double>>(x.begin(), x.end()));
        return Eigen::VectorXcd(Eigen::Map<const Eigen::VectorXcd>(results.data(), kSomeResults));
      },
      Eigen::Map<const Eigen::VectorXd>(leaves.data(), kSomeLeaves));
  EXPECT_LT(compare_jacobians(derived, reference).largest, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Orders, JacobianTest,
                         ::testing::Values(EliminationOrder::kForward, EliminationOrder::kReverse, EliminationOrder::kMarkowitz));

TEST(Jacobian, LinearOutputsHaveLiteralsAndNoOtherEntries) {
  Recording recording;
  const Traced x(&recording, recording.leaf(0, 0, true)), y(&recording, recording.leaf(0, 1, true)), z = 2.0 * x - y;
  const std::vector<JacobianEntry> entries =
      derive_jacobian(&recording, {z.node_in(&recording), y.node()}, {{x.node(), 0, 1.0}, {y.node(), 1, 1.0}});
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].value.value(), 2.0);
  EXPECT_EQ(entries[1].value.value(), -1.0);
  EXPECT_EQ(entries[2].value.value(), 1.0);
  for (const JacobianEntry& entry : entries) EXPECT_TRUE(entry.value.is_literal());
}

/// Leaves that depend on the same variable make one column.
TEST(Jacobian, LeavesOfOneColumnAddUp) {
  Recording recording;
  const Traced f(&recording, recording.leaf(0, 0, true)), g(&recording, recording.leaf(0, 1, true)), h = f * g;
  const std::vector<JacobianEntry> entries = derive_jacobian(&recording, {h.node()}, {{f.node(), 0, 3.0}, {g.node(), 0, 5.0}});
  ASSERT_EQ(entries.size(), 1U);
  const std::vector<double> values = node_values(recording, {7.0, 11.0});
  EXPECT_EQ(values[static_cast<std::size_t>(entries[0].value.node())], 3.0 * 11.0 + 5.0 * 7.0);
}

/// Factors that do not vary are multiplied with each other, so that one product per evaluation remains.
TEST(Jacobian, FactorsOfTheDesignAreMultipliedFirst) {
  Recording recording;
  const Traced m(&recording, recording.leaf(1, 0, false)), n(&recording, recording.leaf(1, 1, false)),
      x(&recording, recording.leaf(0, 0, true));
  const Traced y = m * sin(n * x);
  const std::vector<JacobianEntry> entries = derive_jacobian(&recording, {y.node()}, {{x.node(), 0, 1.0}});
  ASSERT_EQ(entries.size(), 1U);
  const Recording::Node product = recording.node(entries[0].value.node());
  ASSERT_EQ(product.operation, Operation::kMultiply);
  EXPECT_NE(recording.node(product.a).varies, recording.node(product.b).varies);
}

}  // namespace
}  // namespace codesign
