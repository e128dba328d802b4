// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "benchmark/table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

const Table kTable{"speed", "Speed", {"what", "µs"}, {{"a", "1"}, {"longer", "23.5"}}};

TEST(Table, AlignsTextByCharacters) {
  EXPECT_EQ(to_text(kTable), "== Speed\nwhat      µs\na          1\nlonger  23.5\n");
}

TEST(Table, MarkdownStandsBetweenMarkers) {
  EXPECT_EQ(to_markdown(kTable),
            "<!-- table: speed -->\n| what | µs |\n|---|---:|\n| a | 1 |\n| longer | 23.5 |\n<!-- "
            "end: speed -->\n");
}

TEST(Table, ThreeDigits) {
  EXPECT_EQ(three_digits(0.0), "0");
  EXPECT_EQ(three_digits(0.01234), "0.0123");
  EXPECT_EQ(three_digits(0.1234), "0.123");
  EXPECT_EQ(three_digits(1.234), "1.23");
  EXPECT_EQ(three_digits(-12.34), "-12.3");
  EXPECT_EQ(three_digits(1234.0), "1234");
  EXPECT_EQ(three_digits(1.234e-5), "1.23e-05");
  EXPECT_EQ(three_digits(std::nan("")), "-");
}

TEST(Table, OneDigit) {
  EXPECT_EQ(one_digit(3.1e-7), "3e-07");
  EXPECT_EQ(one_digit(std::nan("")), "-");
}

}  // namespace
}  // namespace codesign
