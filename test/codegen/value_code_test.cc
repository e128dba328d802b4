// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/value_code.h"

#include <gtest/gtest.h>

#include "codegen/some_recording.h"
#include "codegen/traced.h"

namespace codesign {
namespace {

#define SKIP_WITHOUT_CODE() \
  if (!ValueCode::is_available()) GTEST_SKIP() << "no machine code on this processor"

TEST(ValueCode, ComputesWhatTheFormulasDo) {
  SKIP_WITHOUT_CODE();
  SomeRecording some;
  ValueTask task;
  task.homes = some.homes();
  for (int k = 0; k < kSomeResults; ++k)
    task.outputs.push_back({some.results[static_cast<std::size_t>(k)], {2, k}});
  // Every third node's value, in its slot.
  for (int n = 0; n < some.recording.size(); n += 3)
    if (task.homes[static_cast<std::size_t>(n)].array < 0) task.kept.push_back(n);
  const ValueProgram program(some.recording, task);
  const std::unique_ptr<ValueCode> code = ValueCode::compile(some.recording, task, program, 3);
  ASSERT_NE(code, nullptr);
  const std::vector<double> leaves = SomeRecording::leaf_values(), expected = some_results(leaves);
  std::vector<double> results(kSomeResults, 0.0),
      slots(static_cast<std::size_t>(program.slots), 0.0);
  EXPECT_TRUE(code->run({leaves.data(), some.literals.data(), results.data(), slots.data()}));
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(results[k], expected[k], 1e-13 * (1.0 + std::abs(expected[k]))) << k;

  const std::vector<double> values = node_values(some.recording, leaves);
  for (int n : task.kept) {
    const double kept = slots[static_cast<std::size_t>(program.slot[static_cast<std::size_t>(n)])],
                 value = values[static_cast<std::size_t>(n)];
    EXPECT_NEAR(kept, value, 1e-13 * (1.0 + std::abs(value))) << "node " << n;
  }
}

class OneOperation : public ::testing::Test {
 protected:
  Recording recording;
  const Traced x{&recording, recording.leaf(0, 0, true)}, y{&recording, recording.leaf(0, 1, true)},
      z{&recording, recording.leaf(0, 2, true)};

  /// The value of a formula of 0.3, -0.7 and 1.9; NaN if a guard does not hold.
  double run(const Traced& formula) {
    ValueTask task;
    task.outputs = {{formula.node(), {1, 0}}};
    task.guards = recording.guards();
    task.homes.resize(static_cast<std::size_t>(recording.size()));
    std::vector<double> literals;
    for (int n = 0; n < recording.size(); ++n) {
      Place& home = task.homes[static_cast<std::size_t>(n)];
      if (recording.node(n).operation == Operation::kLeaf) home = {0, recording.node(n).b};
      if (recording.node(n).operation == Operation::kLiteral) {
        home = {2, static_cast<int>(literals.size())};
        literals.push_back(recording.node(n).literal);
      }
    }
    const ValueProgram program(recording, task);
    const std::unique_ptr<ValueCode> code = ValueCode::compile(recording, task, program, 3);
    const double leaves[] = {0.3, -0.7, 1.9};
    double result = 0.0, slots[16];
    return code->run({leaves, &result, literals.data(), slots}) ? result : std::nan("");
  }
};

TEST_F(OneOperation, IsTheFormulas) {
  SKIP_WITHOUT_CODE();
  EXPECT_DOUBLE_EQ(run(x + y), 0.3 - 0.7);
  EXPECT_DOUBLE_EQ(run(x - y), 1.0);
  EXPECT_DOUBLE_EQ(run(x * y), -0.21);
  EXPECT_DOUBLE_EQ(run(x / y), 0.3 / -0.7);
  EXPECT_DOUBLE_EQ(run(-x), -0.3);
  EXPECT_DOUBLE_EQ(run(sqrt(z)), std::sqrt(1.9));
  EXPECT_DOUBLE_EQ(run(round(z)), 2.0);
  EXPECT_EQ(run(round(x / x * 2.5)), 2.0) << "halves to even, as std::nearbyint";
  EXPECT_TRUE(std::signbit(run(-(x - x * 1.0 + 0.0 * y + round(x))))) << "minus zero";
  EXPECT_DOUBLE_EQ(run(tanh(x)), std::tanh(0.3));
  EXPECT_DOUBLE_EQ(run(exp(x)), std::exp(0.3));
  EXPECT_DOUBLE_EQ(run(sin(x)), std::sin(0.3));
  EXPECT_DOUBLE_EQ(run(cos(x)), std::cos(0.3));
  EXPECT_DOUBLE_EQ(run(asin(x)), std::asin(0.3));
  EXPECT_DOUBLE_EQ(run(atan2(y, x)), std::atan2(-0.7, 0.3));
  EXPECT_DOUBLE_EQ(run(x * y + z), 1.9 - 0.21);
  EXPECT_DOUBLE_EQ(run(x * y - z), -0.21 - 1.9);
  EXPECT_DOUBLE_EQ(run(z - x * y), 1.9 + 0.21);
  EXPECT_DOUBLE_EQ(run(x * x + x), 0.39) << "one operand in all places";
  EXPECT_DOUBLE_EQ(run(x * 4.0), 1.2);
  EXPECT_EQ(run(x), 0.3);
}

TEST_F(OneOperation, StopsWhereAGuardDoesNotHold) {
  SKIP_WITHOUT_CODE();
  is_less(y, x, true);
  is_less(z, x, false);
  EXPECT_DOUBLE_EQ(run(x + y), 0.3 - 0.7) << "both hold";
  is_less(x * x, x + y, true);
  EXPECT_TRUE(std::isnan(run(x + y)));
}

TEST_F(OneOperation, AnEqualOrMissingNumberIsNotLess) {
  SKIP_WITHOUT_CODE();
  is_less(x, x + 0.0 * y, false);
  is_less(sqrt(y), z, false);
  is_less(z, sqrt(y), false);
  EXPECT_DOUBLE_EQ(run(x + y), 0.3 - 0.7);
  is_less(sqrt(y) + 1.0, z, true);
  EXPECT_TRUE(std::isnan(run(x + y)));
}

TEST_F(OneOperation, AGuardBehindACallComparesWhatWasBeforeIt) {
  SKIP_WITHOUT_CODE();
  const Traced sum = x + z, called = sin(sum);
  is_less(called, sum, true);
  EXPECT_DOUBLE_EQ(run(called * sum), std::sin(2.2) * 2.2);
  is_less(sum, called, true);
  EXPECT_TRUE(std::isnan(run(called * sum)));
}

TEST(ValueCode, AHugeProgramIsNotCompiled) {
  SKIP_WITHOUT_CODE();
  Recording recording;
  Traced x(&recording, recording.leaf(0, 0, true));
  const Traced y = x;
  for (int k = 0; k < 300000; ++k) x = x / y;
  ValueTask task;
  task.outputs = {{x.node(), {1, 0}}};
  task.homes.resize(static_cast<std::size_t>(recording.size()));
  task.homes[0] = {0, 0};
  EXPECT_EQ(ValueCode::compile(recording, task, ValueProgram(recording, task), 2), nullptr);
}

}  // namespace
}  // namespace codesign
