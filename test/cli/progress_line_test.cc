// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_line.h"

#include <gtest/gtest.h>

namespace codesign::cli {
namespace {

TEST(ProgressLine, ALongJobHasABoundedNumberOfLines) {
  LinePace pace;
  int lines = 0;
  for (int trial = 0; trial < 1000000; ++trial)
    lines += pace.admits(0.01 * trial) ? 1 : 0;  // 10,000 s
  EXPECT_GT(lines, LinePace::kLines + 200);
  EXPECT_LT(lines, 900);
  LinePace brief;
  for (int trial = 0; trial < LinePace::kLines; ++trial) EXPECT_TRUE(brief.admits(0.0)) << trial;
  EXPECT_FALSE(brief.admits(0.5));
  EXPECT_TRUE(brief.admits(1.5));
}

}  // namespace
}  // namespace codesign::cli
