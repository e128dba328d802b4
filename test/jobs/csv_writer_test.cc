// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/csv_writer.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace codesign {
namespace {

TEST(CsvWriter, WritesHeaderAndRows) {
  std::ostringstream out;
  CsvWriter csv(out, {"time", "crank_joint/velocity"});
  csv.write(std::vector<double>{0.0, -10.0});
  csv.write(std::vector<double>{0.02, 1.0 / 3.0});
  EXPECT_EQ(out.str(), "time,crank_joint/velocity\n0,-10\n0.02,0.3333333333333333\n");
  EXPECT_EQ(std::strtod("0.3333333333333333", nullptr), 1.0 / 3.0);
}

TEST(CsvWriter, QuotesWhatWouldBreakARow) {
  std::ostringstream out;
  CsvWriter csv(out, {"plain", "a,b", "say \"x\"", "two\nlines"});
  EXPECT_EQ(out.str(), "plain,\"a,b\",\"say \"\"x\"\"\",\"two\nlines\"\n");
}

TEST(CsvWriter, KeepsEmptyCells) {
  std::ostringstream out;
  CsvWriter csv(out, {"a", "b", "c"});
  csv.write(std::vector<std::string>{"1", "", "3"});
  EXPECT_EQ(out.str(), "a,b,c\n1,,3\n");
}

}  // namespace
}  // namespace codesign
