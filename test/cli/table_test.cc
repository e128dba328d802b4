// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/table.h"

#include <gtest/gtest.h>

#include <sstream>

#include "text/number_text.h"

namespace codesign::cli {
namespace {

TEST(Table, AlignsColumns) {
  Table table;
  table.add({"parameter", "value"});
  table.add({"Kp", "-0.25"});
  table.add({"crank_length", "1000000"});
  table.add({"alone"});
  std::ostringstream out;
  table.print(out);
  EXPECT_EQ(out.str(), "parameter       value\nKp              -0.25\ncrank_length  1000000\nalone\n");
}

TEST(Table, ReadableNumbersHaveTenDigits) {
  EXPECT_EQ(readable(0.05925272691234), "0.05925272691");
  EXPECT_EQ(readable(-10.0), "-10");
}

}  // namespace
}  // namespace codesign::cli
