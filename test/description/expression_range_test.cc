// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_range.h"

#include <gtest/gtest.h>

#include <cmath>

#include "description/expression.h"

namespace codesign {
namespace {

const std::vector<std::string> kTwo{"a", "b"};
const std::vector<ValueRange> kTheirRanges{{1.0, 2.0}, {-3.0, 4.0}};

ValueRange range(const std::string& text) { return Expression(text, kTwo).range(kTheirRanges); }

void expect_range(const std::string& text, double lower, double upper) {
  EXPECT_EQ(range(text).lower, lower) << text;
  EXPECT_EQ(range(text).upper, upper) << text;
}

TEST(ExpressionRange, IsThatOfTheValues) {
  expect_range("7", 7.0, 7.0);
  expect_range("a + b", -2.0, 6.0);
  expect_range("a - b", -3.0, 5.0);
  expect_range("-a", -2.0, -1.0);
  expect_range("a * b", -6.0, 8.0);
  expect_range("b * b", -12.0, 16.0);
  expect_range("b / a", -3.0, 4.0);
  expect_range("1 / a", 0.5, 1.0);
  expect_range("-2 * (a - 3)", 2.0, 4.0);
}

TEST(ExpressionRange, HoldsEveryValue) {
  for (const char* text : {"2*a - 3*b + 1", "a*b - b/a", "(a - b)*(a + b)", "a/(b + 5)"}) {
    const Expression expression(text, kTwo);
    const ValueRange all = expression.range(kTheirRanges);
    for (double u = 0.0; u <= 1.0; u += 0.125)
      for (double v = 0.0; v <= 1.0; v += 0.125) {
        const double value = expression.value(std::vector<double>{1.0 + u, -3.0 + 7.0 * v});
        EXPECT_GE(value, all.lower - 1e-12) << text;
        EXPECT_LE(value, all.upper + 1e-12) << text;
      }
  }
}

TEST(ExpressionRange, IsUnknownOfOtherOperations) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* text : {"a / b", "sqrt(a)", "a ** 2", "a < b ? a : b", "1 + abs(b)"}) expect_range(text, -infinity, infinity);
  EXPECT_EQ(Expression("0 * a", kTwo).range({{1.0, infinity}, {}}).upper, infinity) << "0 * infinity is undefined";
}

}  // namespace
}  // namespace codesign
