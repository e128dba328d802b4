// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/formula.h"

#include <gtest/gtest.h>

#include <cmath>

#include "codegen/traced.h"

namespace codesign {
namespace {

const std::vector<std::string> kVariables{"x", "y"};

double value_of_text(const std::string& text, double x, double y) {
  return evaluate_formula<double>(Expression(text, kVariables).steps(),
                                  Expression(text, kVariables).dependencies().size() == 2
                                      ? std::vector<double>{x, y}
                                      : std::vector<double>{x});
}

// The functions of expressions exist twice: for complex numbers, and here for any scalar.
TEST(Formula, EveryFunctionIsThatOfExpressions) {
  for (const ExpressionFunction& function : expression_function_table()) {
    const std::string name = function.name;
    const std::string text = name + (function.count == 1 ? "(x)" : "(x, y)");
    for (const double x : {0.3, 0.8})
      for (const double y : {0.7, -1.6}) {
        const double expected = Expression(text, kVariables).value(std::vector<double>{x, y});
        EXPECT_NEAR(value_of_text(text, x, y), expected, 1e-14 * (1.0 + std::abs(expected)))
            << text;
      }
  }
  for (const char* text : {"abs(x)", "sign(x)", "floor(x)", "ceil(x)", "atan(x)", "-x", "x^3",
                           "x^-2", "x**2 - 3*x/7"}) {
    EXPECT_NEAR(value_of_text(text, -1.4, 0.0),
                Expression(text, kVariables).value(std::vector<double>{-1.4, 0.0}), 1e-14)
        << text;
  }
  EXPECT_EQ(value_of_text("sign(x)", 0.0, 0.0), 0.0);
  EXPECT_EQ(value_of_text("floor(x)", 2.0, 0.0), 2.0);
  EXPECT_EQ(value_of_text("ceil(x)", 2.0, 0.0), 2.0);
}

TEST(Formula, DecidesOnBothSidesOfEveryComparison) {
  for (const char* text : {"x < y ? 1 : 2", "x <= y ? 1 : 2", "x > y ? 1 : 2", "x >= y ? 1 : 2",
                           "x == y ? 1 : 2", "x != y ? 1 : 2", "(x < y ? x : y) + (x > 0 ? 3 : 4)"})
    for (const double x : {-1.0, 0.5, 2.0})
      EXPECT_EQ(value_of_text(text, x, 0.5),
                Expression(text, kVariables).value(std::vector<double>{x, 0.5}))
          << text << " " << x;
}

TEST(Formula, AWholePowerOfTheTextIsAProductAndAnyOtherNeedsAPositiveBase) {
  EXPECT_EQ(value_of_text("x^3", -2.0, 0.0), -8.0);
  EXPECT_NEAR(value_of_text("x^1.5", 4.0, 0.0), 8.0, 1e-14);
  EXPECT_TRUE(std::isnan(value_of_text("x^1.5", -4.0, 0.0)));
  EXPECT_NEAR(value_of_text("x^y", 2.0, 3.0), 8.0, 1e-14);
}

TEST(Formula, IsRecorded) {
  Recording recording;
  const std::vector<Traced> variables{Traced(&recording, recording.leaf(0, 0, true)),
                                      Traced(&recording, recording.leaf(0, 1, true))};
  const Expression expression("max(x, y)*x^2", kVariables);
  const Traced result = evaluate_formula<Traced>(expression.steps(), variables);
  EXPECT_FALSE(result.is_literal());
  EXPECT_FALSE(recording.refused());
  EXPECT_EQ(recording.guards().size(), 1U);
}

}  // namespace
}  // namespace codesign
