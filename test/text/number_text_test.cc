// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "text/number_text.h"

namespace codesign {
namespace {

TEST(Decimal, IsShortest) {
  EXPECT_EQ(to_decimal(0.07), "0.07");
  EXPECT_EQ(to_decimal(-10.0), "-10");
  EXPECT_EQ(to_decimal(1e-6), "1e-06");
}

TEST(Decimal, ReadsBackAsTheSameDouble) {
  for (const double value : {1.0 / 3.0, 0.1 + 0.2, -1.7976931348623157e308, 5e-324, 0.05925272691})
    EXPECT_EQ(std::strtod(to_decimal(value).c_str(), nullptr), value);
}

TEST(Decimal, WritesWhatIsNotFinite) {
  EXPECT_EQ(to_decimal(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(to_decimal(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(to_decimal(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(NumberText, ReadsWholeNumbersOnly) {
  EXPECT_EQ(parse_number("0.25"), 0.25);
  EXPECT_EQ(parse_number("-1e-3"), -1e-3);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  for (const char* text : {"", "1,5", "1.5m", " 1", "1 ", "+-1", "--1", "0x1", "one", "+", "1e"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(NumberText, WhatIsTooSmallIsZero) {
  EXPECT_EQ(parse_number("1e-400"), 0.0);
  EXPECT_FALSE(parse_number("1e400"));
  EXPECT_FALSE(parse_number("1e-400m"));
}

TEST(NumberText, LeavesFinitenessToTheCaller) {
  EXPECT_TRUE(std::isnan(*parse_number("nan")));
  EXPECT_TRUE(std::isinf(*parse_number("-inf")));
}

TEST(NumberText, FormatsAndSplits) {
  EXPECT_EQ(format_numbers({0.1, -2.0, 1e-20}), "0.1 -2 1e-20");
  EXPECT_EQ(split_words("  a\tb\n c "), (std::vector<std::string>{"a", "b", "c"}));
}

TEST(NumberText, ReadableHasAsManyDigitsAsAsked) {
  EXPECT_EQ(readable(0.1), "0.1");
  EXPECT_EQ(readable(1.0 / 3.0), "0.3333333333");
  EXPECT_EQ(readable(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(readable(12345.0, 3), "1.23e+04");
  EXPECT_EQ(readable(-0.0, 3), "-0");
}

TEST(NumberText, EndsAreComparedWhole) {
  EXPECT_TRUE(ends_with("drake:ball_constraint", "_constraint"));
  EXPECT_TRUE(ends_with("same", "same"));
  EXPECT_FALSE(ends_with("straint", "constraint"));
  EXPECT_FALSE(ends_with("constraints", "constraint"));
}

TEST(Readable, HasTenDigits) {
  EXPECT_EQ(readable(0.05925272691234), "0.05925272691");
  EXPECT_EQ(readable(-10.0), "-10");
}

}  // namespace

}  // namespace codesign
