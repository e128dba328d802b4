// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "codegen/operate.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace codesign
