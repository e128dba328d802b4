// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_functions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/expression.h"

namespace codesign {
namespace {

const std::vector<std::string> kNames = {"x", "y", "i", "e"};
const std::vector<double> kAt = {0.7, -1.3, 2.0, 5.0};

double value_of_text(const std::string& text) { return Expression(text, kNames).value(kAt); }

TEST(ExpressionFunctions, ComputesAsPythonDoes) {
  EXPECT_DOUBLE_EQ(value_of_text("1 + 2*3 - 4/8"), 6.5);
  EXPECT_DOUBLE_EQ(value_of_text("1/3"), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("2**3**2"), 512.0);
  EXPECT_DOUBLE_EQ(value_of_text("2^-1"), 0.5);
  EXPECT_DOUBLE_EQ(value_of_text("-2**2"), -4.0);
  EXPECT_DOUBLE_EQ(value_of_text("(-2)**3"), -8.0);
  EXPECT_DOUBLE_EQ(value_of_text("+x - -y"), 0.7 - 1.3);
  EXPECT_DOUBLE_EQ(value_of_text("2.5e-1*1E2 + .5"), 25.5);
  EXPECT_DOUBLE_EQ(value_of_text("i*e"), 10.0);
  EXPECT_DOUBLE_EQ(value_of_text("x < 1 ? 3 : 4"), 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("x >= 1 ? 1 : y == -1.3 ? 5 : 6"), 5.0);
  EXPECT_DOUBLE_EQ(value_of_text("min(3, x, 2) + max(y, x)"), 1.4);
  EXPECT_DOUBLE_EQ(value_of_text("abs(y) + sign(y) + floor(y) + ceil(y)"), 1.3 - 1.0 - 2.0 - 1.0);
  EXPECT_DOUBLE_EQ(value_of_text("degrees(pi) + radians(180)"), 180.0 + M_PI);
  EXPECT_DOUBLE_EQ(value_of_text("log(x) + log10(100) + exp(0)"), std::log(0.7) + 3.0);
  EXPECT_DOUBLE_EQ(value_of_text("atan2(y, -x)"), std::atan2(-1.3, -0.7));
}

TEST(ExpressionFunctions, DerivativesAreExact) {
  struct Case {
    const char* text;
    double dx, dy;
  };
  const double x = kAt[0], y = kAt[1], r2 = x * x + y * y;
  const std::vector<Case> cases = {
      {"x*y", y, x},
      {"x/y", 1.0 / y, -x / (y * y)},
      {"x**3", 3.0 * x * x, 0.0},
      {"y**3", 0.0, 3.0 * y * y},
      {"pow(y, 2)", 0.0, 2.0 * y},
      {"x**-2", -2.0 / (x * x * x), 0.0},
      {"x**2.5", 2.5 * std::pow(x, 1.5), 0.0},
      {"x**y", y * std::pow(x, y - 1.0), std::pow(x, y) * std::log(x)},
      {"(x - 0.7)**2", 0.0, 0.0},
      {"(x - 0.7)**1", 1.0, 0.0},
      {"sqrt(x)", 0.5 / std::sqrt(x), 0.0},
      {"sin(x) + cos(y) + tan(x)", std::cos(x) + 1.0 + std::tan(x) * std::tan(x), -std::sin(y)},
      {"asin(x) - acos(x)", 2.0 / std::sqrt(1.0 - x * x), 0.0},
      {"atan(y)", 0.0, 1.0 / (1.0 + y * y)},
      {"atan2(y, x)", -y / r2, x / r2},
      {"sinh(x)*cosh(x)", std::cosh(2.0 * x), 0.0},
      {"tanh(x)", 1.0 - std::tanh(x) * std::tanh(x), 0.0},
      {"exp(x*y)", y * std::exp(x * y), x * std::exp(x * y)},
      {"log(x)", 1.0 / x, 0.0},
      {"log10(x)", 1.0 / (x * std::log(10.0)), 0.0},
      {"abs(x) + abs(y)", 1.0, -1.0},
      {"max(x, y) - 2*min(x, y)", 1.0, -2.0},
      {"x > y ? x**2 : y", 2.0 * x, 0.0},
      {"degrees(x) + radians(y)", 180.0 / M_PI, M_PI / 180.0},
      {"floor(x) + sign(y) + ceil(y)", 0.0, 0.0},
  };
  for (const Case& c : cases) {
    const Expression expression(c.text, kNames);
    EXPECT_NEAR(expression.derivative(0, kAt), c.dx, 1e-14 * (1.0 + std::abs(c.dx))) << c.text;
    EXPECT_NEAR(expression.derivative(1, kAt), c.dy, 1e-14 * (1.0 + std::abs(c.dy))) << c.text;
    EXPECT_EQ(expression.derivative(2, kAt), 0.0) << c.text;
  }
}

TEST(ExpressionFunctions, DerivativesAreInfiniteWhereTheyAre) {
  EXPECT_EQ(Expression("sqrt(x)", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("x**0.5", kNames).derivative(0, {0.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("asin(x)", kNames).derivative(0, {1.0, 0.0, 0.0, 0.0}), HUGE_VAL);
  EXPECT_EQ(Expression("acos(x)", kNames).derivative(0, {-1.0, 0.0, 0.0, 0.0}), -HUGE_VAL);
  EXPECT_EQ(Expression("sqrt(x - 1) + y", kNames).derivative(1, {1.0, 0.0, 0.0, 0.0}), 1.0);
}

}  // namespace
}  // namespace codesign
