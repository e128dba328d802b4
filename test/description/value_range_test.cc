// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/value_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "description/expression.h"

namespace codesign {
namespace {

struct Case {
  const char* text;
  ValueRange x, y;
};

// Where a function turns round, jumps or ends, and between.
const std::vector<Case> kCases = {{"sin(x)", {0.2, 0.9}, 0.0},
                                  {"sin(x)", {0.2, 2.0}, 0.0},
                                  {"sin(x)", {4.0, 5.0}, 0.0},
                                  {"sin(x)", {-9.0, 9.0}, 0.0},
                                  {"cos(x)", {0.2, 0.9}, 0.0},
                                  {"cos(x)", {-0.1, 0.3}, 0.0},
                                  {"cos(x)", {3.0, 3.5}, 0.0},
                                  {"tan(x)", {-1.5, 1.5}, 0.0},
                                  {"tan(x)", {1.6, 4.7}, 0.0},
                                  {"asin(x)", {-1.0, 0.5}, 0.0},
                                  {"acos(x)", {-0.5, 1.0}, 0.0},
                                  {"atan(x)", {-2.0, 30.0}, 0.0},
                                  {"atan2(x, y)", {1.0, 2.0}, {-1.0, 3.0}},
                                  {"atan2(x, y)", {-2.0, 1.0}, {0.5, 3.0}},
                                  {"atan2(x, y)", {-2.0, -1.0}, {-3.0, -2.0}},
                                  {"atan2(x, y)", {0.5, 1.0}, {-3.0, -2.0}},
                                  {"sinh(x)", {-1.0, 2.0}, 0.0},
                                  {"cosh(x)", {-1.0, 2.0}, 0.0},
                                  {"cosh(x)", {-3.0, -1.0}, 0.0},
                                  {"tanh(x)", {-1.0, 2.0}, 0.0},
                                  {"exp(x)", {-1.0, 2.0}, 0.0},
                                  {"log(x)", {0.5, 2.0}, 0.0},
                                  {"log10(x)", {0.5, 200.0}, 0.0},
                                  {"sqrt(x)", {0.0, 2.0}, 0.0},
                                  {"x**2", {-1.0, 2.0}, 0.0},
                                  {"x**2", {-3.0, -2.0}, 0.0},
                                  {"x**3", {-3.0, 2.0}, 0.0},
                                  {"x**-2", {-3.0, -2.0}, 0.0},
                                  {"x**-3", {-3.0, -2.0}, 0.0},
                                  {"x**0", {-3.0, 2.0}, 0.0},
                                  {"x**y", {0.5, 2.0}, {-1.0, 2.0}},
                                  {"x**y", {0.0, 2.0}, {0.0, 0.5}},
                                  {"abs(x)", {-3.0, 2.0}, 0.0},
                                  {"abs(x)", {-3.0, -2.0}, 0.0},
                                  {"sign(x)", {-3.0, 2.0}, 0.0},
                                  {"sign(x)", {0.0, 2.0}, 0.0},
                                  {"min(x, y)", {-3.0, 2.0}, {-2.0, 1.0}},
                                  {"max(x, y)", {-3.0, 2.0}, {-2.0, 1.0}},
                                  {"floor(x)", {-0.5, 2.0}, 0.0},
                                  {"ceil(x)", {-1.5, 2.5}, 0.0},
                                  {"radians(x)", {-90.0, 180.0}, 0.0},
                                  {"degrees(x)", {-1.0, 2.0}, 0.0},
                                  {"x < y ? 1 : 2", {0.0, 1.0}, {2.0, 3.0}},
                                  {"x < y ? 1 : 2", {0.0, 1.0}, {-3.0, 0.0}},
                                  {"x <= y ? 1 : 2", {0.0, 1.0}, {1.0, 3.0}},
                                  {"x > y ? 1 : 2", {0.0, 2.0}, {1.0, 3.0}},
                                  {"x >= y ? 1 : 2", {2.0, 4.0}, {1.0, 2.0}},
                                  {"x == y ? 1 : 2", {2.0, 4.0}, {1.0, 1.5}},
                                  {"x != y ? 1 : 2", 1.0, 1.0},
                                  {"x < 0.5 ? y : 7", {0.0, 1.0}, {-1.0, 0.5}}};

// Each variable appears once, so that the range is that of the values and not wider.
TEST(ValueRange, IsThatOfTheValues) {
  constexpr int kSamples = 100;  // even, so that an end of y and the middle are met
  for (const Case& one : kCases) {
    const Expression expression(one.text, {"x", "y"});
    const ValueRange range = expression.range({one.x, one.y});
    double least = HUGE_VAL, largest = -HUGE_VAL;
    for (int i = 0; i <= kSamples; ++i)
      for (int j = 0; j <= kSamples; ++j) {
        const double x = one.x.lower + (one.x.upper - one.x.lower) * i / kSamples,
                     y = one.y.lower + (one.y.upper - one.y.lower) * j / kSamples;
        const double value = expression.value(std::vector<double>{x, y});
        least = std::min(least, value);
        largest = std::max(largest, value);
      }
    const double slack = 1e-12 * (1.0 + std::abs(largest)), width = 1e-2 * (1.0 + largest - least);
    EXPECT_LE(range.lower, least + slack) << one.text << " " << one.x.lower;
    EXPECT_GE(range.upper, largest - slack) << one.text << " " << one.x.lower;
    EXPECT_GE(range.lower, least - width) << one.text << " " << one.x.lower;
    EXPECT_LE(range.upper, largest + width) << one.text << " " << one.x.lower;
  }
}

TEST(ValueRange, IsAllNumbersBeyondAPoleAndTheWholeCircleBesideTheJumpOfTheAngle) {
  const auto range = [](const char* text, ValueRange x, ValueRange y) {
    return Expression(text, {"x", "y"}).range({x, y});
  };
  EXPECT_EQ(range("tan(x)", {1.5, 1.6}, 0.0).upper, HUGE_VAL);
  EXPECT_EQ(range("tan(x)", {-1.0, 3.0}, 0.0).lower, -HUGE_VAL);
  EXPECT_EQ(range("x**-1", {-1.0, 3.0}, 0.0).lower, -HUGE_VAL);
  EXPECT_EQ(range("x**y", {-1.0, 3.0}, {2.0, 2.5}).lower, -HUGE_VAL);
  EXPECT_EQ(range("atan2(x, y)", {-0.1, 0.1}, {-2.0, -1.0}).upper, M_PI);
  EXPECT_EQ(range("atan2(x, y)", {-0.1, 0.1}, {-2.0, -1.0}).lower, -M_PI);
  EXPECT_EQ(range("sin(x)", {}, 0.0).upper, 1.0);
  EXPECT_EQ(range("exp(x)", {}, 0.0).lower, 0.0);
}

}  // namespace
}  // namespace codesign
