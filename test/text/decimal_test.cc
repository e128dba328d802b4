// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/decimal.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

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

}  // namespace
}  // namespace codesign
