// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace codesign {
namespace {

TEST(Table, AlignsColumns) {
  Table table;
  table.add({"parameter", "value"});
  table.add({"Kp", "-0.25"});
  table.add({"crank_length", "1000000"});
  table.add({"alone"});
  std::ostringstream out;
  table.print(out);
  EXPECT_EQ(out.str(),
            "parameter       value\nKp              -0.25\ncrank_length  1000000\nalone\n");
}

}  // namespace
}  // namespace codesign
