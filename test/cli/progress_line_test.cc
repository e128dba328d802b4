// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/progress_line.h"

#include <gtest/gtest.h>

namespace codesign::cli {
namespace {

TEST(ProgressLine, SaysWhatIsDoneHowFastAndHowLong) {
  Progress progress;
  progress.stage = SearchStage::kScreening;
  progress.done = 12;
  progress.of = 400;
  progress.runs = 288;
  progress.runs_per_second = 31.25;
  progress.seconds_left = 298.0;
  EXPECT_EQ(progress_line(progress),
            "screening: 12 of 400 points, 288 runs, 31.2 runs/s, about 5 min left");
  progress.stage = SearchStage::kSearching;
  progress.starts = progress.of = 100;
  progress.seconds_left = 12.34;
  EXPECT_EQ(progress_line(progress),
            "searching: 12 of 100 searches ended, 288 runs, 31.2 runs/s, about 12 s left");
  progress.seconds_left = 111.0;
  EXPECT_NE(progress_line(progress).find("about 111 s left"), std::string::npos);
  progress.starts = 0;
  progress.of = 200;
  progress.is_bound = true;
  progress.seconds_left = 9000.0;
  EXPECT_EQ(progress_line(progress),
            "searching: 12 of at most 200 evaluations, 288 runs, 31.2 runs/s, at most 2.5 h left");
}

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

TEST(ProgressLine, LeavesOutWhatIsNotKnown) {
  Progress progress;
  progress.stage = SearchStage::kValidating;
  progress.of = 1000;
  EXPECT_EQ(progress_line(progress), "validating: 0 of 1000 runs, 0 runs");
}

}  // namespace
}  // namespace codesign::cli
