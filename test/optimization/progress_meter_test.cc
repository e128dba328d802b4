// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/progress_meter.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace codesign {
namespace {

void compute(ProgressMeter* meter, int runs) {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  for (int k = 0; k < runs; ++k) meter->count_run(true);
}

TEST(ProgressMeter, ScreeningIsOfPoints) {
  ProgressMeter meter(100, nullptr);
  meter.begin(SearchStage::kScreening, 40, 6);
  EXPECT_FALSE(meter.now().seconds_left) << "nothing is computed yet";
  compute(&meter, 60);
  for (int k = 0; k < 10; ++k) meter.count_point();
  const Progress progress = meter.now();
  EXPECT_EQ(progress.stage, SearchStage::kScreening);
  EXPECT_EQ(progress.done, 10);
  EXPECT_EQ(progress.of, 40);
  EXPECT_EQ(progress.runs, 60);
  EXPECT_FALSE(progress.is_bound);
  EXPECT_NEAR(*progress.seconds_left * progress.runs_per_second, 180.0, 1e-6);
}

TEST(ProgressMeter, OneSearchIsBoundByItsEvaluations) {
  ProgressMeter meter(200, nullptr);
  meter.begin(SearchStage::kSearching, 0, 4);
  compute(&meter, 12);
  for (int k = 0; k < 3; ++k) meter.count_trial();
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 3);
  EXPECT_EQ(progress.of, 200);
  EXPECT_EQ(progress.starts, 0);
  EXPECT_TRUE(progress.is_bound);
  EXPECT_NEAR(*progress.seconds_left * progress.runs_per_second, 4.0 * 197, 1e-6);
}

TEST(ProgressMeter, SearchesThatEndedTellHowLongTheOthersTake) {
  ProgressMeter meter(200, nullptr);
  meter.begin(SearchStage::kSearching, 10, 1);
  for (int k = 0; k < 25; ++k) meter.count_trial();
  compute(&meter, 25);
  // One reading: time passes between two.
  const Progress first = meter.now();
  EXPECT_TRUE(first.is_bound);
  EXPECT_NEAR(*first.seconds_left * first.runs_per_second, 2000.0 - 25, 1e-6);
  meter.end_search(8);
  meter.end_search(12);
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 2);
  EXPECT_EQ(progress.of, 10);
  EXPECT_EQ(progress.starts, 10);
  EXPECT_FALSE(progress.is_bound);
  EXPECT_NEAR(*progress.seconds_left * progress.runs_per_second, 75.0, 1e-6)
      << "ten searches of ten trials";
}

TEST(ProgressMeter, RememberedRunsCountButAreNoMeasureOfSpeed) {
  ProgressMeter meter(200, nullptr);
  meter.begin(SearchStage::kSearching, 0, 1);
  for (int k = 0; k < 1000; ++k) meter.count_run(false);
  EXPECT_EQ(meter.now().runs, 1000);
  EXPECT_EQ(meter.now().remembered, 1000);
  EXPECT_EQ(meter.now().runs_per_second, 0.0);
  EXPECT_FALSE(meter.now().seconds_left);
}

TEST(ProgressMeter, ValidatingIsOfRuns) {
  ProgressMeter meter(200, nullptr);
  compute(&meter, 7);
  meter.begin(SearchStage::kValidating, 1, 50);
  compute(&meter, 20);
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 20);
  EXPECT_EQ(progress.of, 50);
  EXPECT_EQ(progress.runs, 27);
  EXPECT_NEAR(*progress.seconds_left * progress.runs_per_second, 30.0, 1e-6);
}

TEST(ProgressMeter, TellsNowAndThenAndAtTheEndOfScreening) {
  int told = 0;
  ProgressMeter seldom(
      200, [&told](const Progress&) { ++told; }, std::chrono::hours(1));
  seldom.begin(SearchStage::kScreening, 3, 1);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(told, 0);
    seldom.count_run(true);
    seldom.count_point();
  }
  EXPECT_EQ(told, 1);
  ProgressMeter often(
      200, [&told](const Progress&) { ++told; }, std::chrono::hours(0));
  often.count_run(true);
  often.end_search(3);
  EXPECT_EQ(told, 3);
}

}  // namespace
}  // namespace codesign
