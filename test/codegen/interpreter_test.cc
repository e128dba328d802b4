// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The tests of equations/ compare the interpreter with the machine code, to the last bit, for every
// element and joint.
#include <gtest/gtest.h>
#include <cmath>
#include <complex>

#include "codegen/interpreter.h"
#include "codegen/some_recording.h"
#include "codegen/traced.h"

namespace codesign {
namespace {

TEST(Operate, IsTheFormulaOfEachOperation) {
  const auto of = [](Operation operation) { return operate(operation, 0.3, -0.7); };
  EXPECT_EQ(of(Operation::kAdd), 0.3 - 0.7);
  EXPECT_EQ(of(Operation::kSubtract), 1.0);
  EXPECT_EQ(of(Operation::kMultiply), 0.3 * -0.7);
  EXPECT_EQ(of(Operation::kDivide), 0.3 / -0.7);
  EXPECT_EQ(of(Operation::kNegate), -0.3);
  EXPECT_EQ(of(Operation::kSquareRoot), std::sqrt(0.3));
  EXPECT_EQ(of(Operation::kTanh), std::tanh(0.3));
  EXPECT_EQ(of(Operation::kExp), std::exp(0.3));
  EXPECT_EQ(of(Operation::kLog), std::log(0.3));
  EXPECT_EQ(of(Operation::kSin), std::sin(0.3));
  EXPECT_EQ(of(Operation::kCos), std::cos(0.3));
  EXPECT_EQ(of(Operation::kArcSine), std::asin(0.3));
  EXPECT_EQ(of(Operation::kArcTangent), std::atan2(0.3, -0.7));
}

TEST(Operate, RoundsHalvesToEven) {
  EXPECT_EQ(operate(Operation::kRound, 2.5, 0.0), 2.0);
  EXPECT_EQ(operate(Operation::kRound, -3.5, 0.0), -4.0);
}

TEST(Operate, CarriesDerivatives) {
  using L = Lanes<4>;
  const L a(0.3, L::Vector{1.0, 0.0, 0.0, 0.0}), b(-0.7, L::Vector{0.0, 1.0, 0.0, 0.0});
  const L quotient = operate(Operation::kDivide, a, b);
  EXPECT_NEAR(quotient.v[0], 1.0 / -0.7, 1e-15);
  EXPECT_NEAR(quotient.v[1], -0.3 / 0.49, 1e-15);
  EXPECT_EQ(operate(Operation::kRound, a, b).v[0], 0.0);
}

constexpr int kInputs = 0, kOutputs = 1, kSlots = 2, kLiterals = 3;

/// Leaf k of array kInputs.
Traced input(Recording* recording, int k) { return {recording, recording->leaf(kInputs, k, true)}; }

struct Program {
  Program(const Recording& from, const std::vector<Traced>& results) : recording(from) {
    task.homes.resize(static_cast<std::size_t>(recording.size()));
    for (int n = 0; n < recording.size(); ++n) {
      const Recording::Node& node = recording.node(n);
      if (node.operation == Operation::kLeaf)
        task.homes[static_cast<std::size_t>(n)] = {node.a, node.b};
      if (node.operation != Operation::kLiteral) continue;
      task.homes[static_cast<std::size_t>(n)] = {kLiterals, static_cast<int>(literals.size())};
      literals.push_back(node.literal);
    }
    for (std::size_t k = 0; k < results.size(); ++k)
      task.outputs.push_back({results[k].node(), {kOutputs, static_cast<int>(k)}});
    task.guards = recording.guards();
  }

  template <class T>
  int run(const std::vector<T>& inputs, std::vector<T>* outputs) const {
    const ValueProgram program(recording, task);
    std::vector<T> slots(static_cast<std::size_t>(program.slots));
    const std::vector<T> constants(literals.begin(), literals.end());
    outputs->resize(task.outputs.size());
    std::array<const T*, kCodeArrays> arrays{};
    arrays[kInputs] = inputs.data(), arrays[kOutputs] = outputs->data(),
    arrays[kSlots] = slots.data(), arrays[kLiterals] = constants.data();
    return Interpreter(recording, task, program, kSlots).execute<T>(arrays);
  }

  const Recording& recording;
  ValueTask task;
  std::vector<double> literals;
};

TEST(Interpreter, RoundsAFusedProductOnce) {
  Recording recording;
  const Traced x = input(&recording, 0), y = input(&recording, 1), z = input(&recording, 2);
  const Program program(recording, {x * y + z, x * x - z, z - y * y});
  const std::vector<double> at = {1.0 + 1e-9, 1.0 - 1e-9, -1.0};
  std::vector<double> results;
  EXPECT_EQ(program.run(at, &results), -1);
  EXPECT_EQ(results[0], std::fma(at[0], at[1], at[2]));
  EXPECT_EQ(results[1], std::fma(at[0], at[0], -at[2]));
  EXPECT_EQ(results[2], std::fma(-at[1], at[1], at[2]));
}

TEST(Interpreter, GivesDerivativesByTheComplexStep) {
  Recording recording;
  const Traced x = input(&recording, 0), y = input(&recording, 1);
  const Program program(recording, {tanh(x * y) + exp(x) / y, atan2(y, x)});
  std::vector<std::complex<double>> results;
  const double h = 1e-30;
  EXPECT_EQ(program.run<std::complex<double>>({{0.4, h}, {1.3, 0.0}}, &results), -1);
  const double t = std::tanh(0.4 * 1.3);
  EXPECT_NEAR(results[0].imag() / h, 1.3 * (1.0 - t * t) + std::exp(0.4) / 1.3, 1e-14);
  EXPECT_NEAR(results[1].imag() / h, -1.3 / (0.4 * 0.4 + 1.3 * 1.3), 1e-15);
}

TEST(Interpreter, TellsTheFirstDecisionThatFails) {
  Recording recording;
  const Traced x = input(&recording, 0), y = input(&recording, 1);
  EXPECT_TRUE(is_less(x, Traced(1.0), true));
  EXPECT_FALSE(is_less(y, Traced(2.0), false));
  const Program program(recording, {x + y});
  std::vector<double> results;
  EXPECT_EQ(program.run<double>({0.0, 3.0}, &results), -1);
  EXPECT_EQ(program.run<double>({0.0, 1.0}, &results), 1);
  EXPECT_EQ(program.run<double>({1.5, 1.0}, &results), 0);
  EXPECT_EQ(program.run<double>({std::nan(""), 3.0}, &results), 0)
      << "a comparison with NaN is false";
}

}  // namespace

}  // namespace codesign
