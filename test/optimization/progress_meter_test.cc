// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/progress_meter.h"

#include <gtest/gtest.h>

#include <vector>

namespace codesign {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// The clock of the meters stands still unless a test moves it.
class ProgressMeterTest : public testing::Test {
 protected:
  const std::function<ProgressMeter::Clock::time_point()> clock_ = [this] { return now_; };
  ProgressMeter::Clock::time_point now_{};

  /// So many runs in two seconds.
  void compute(ProgressMeter* meter, int runs) {
    now_ += seconds(2);
    for (int k = 0; k < runs; ++k) meter->count_run(true);
  }
};

TEST_F(ProgressMeterTest, ScreeningIsOfPoints) {
  ProgressMeter meter(100, nullptr, seconds(1), clock_);
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
  EXPECT_DOUBLE_EQ(progress.runs_per_second, 30.0);
  EXPECT_DOUBLE_EQ(*progress.seconds_left, 180.0 / 30.0);
}

TEST_F(ProgressMeterTest, OneSearchIsBoundByItsEvaluations) {
  ProgressMeter meter(200, nullptr, seconds(1), clock_);
  meter.begin(SearchStage::kSearching, 0, 4);
  compute(&meter, 12);
  for (int k = 0; k < 3; ++k) meter.count_trial();
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 3);
  EXPECT_EQ(progress.of, 200);
  EXPECT_EQ(progress.starts, 0);
  EXPECT_TRUE(progress.is_bound);
  EXPECT_DOUBLE_EQ(*progress.seconds_left, 4.0 * 197 / 6.0);
}

TEST_F(ProgressMeterTest, SearchesThatEndedTellHowLongTheOthersTake) {
  ProgressMeter meter(200, nullptr, seconds(1), clock_);
  meter.begin(SearchStage::kSearching, 10, 1);
  for (int k = 0; k < 25; ++k) meter.count_trial();
  compute(&meter, 25);
  EXPECT_TRUE(meter.now().is_bound);
  EXPECT_DOUBLE_EQ(*meter.now().seconds_left, (2000.0 - 25) / 12.5);
  meter.end_search(8);
  meter.end_search(12);
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 2);
  EXPECT_EQ(progress.of, 10);
  EXPECT_EQ(progress.starts, 10);
  EXPECT_FALSE(progress.is_bound);
  EXPECT_DOUBLE_EQ(*progress.seconds_left, 75.0 / 12.5) << "ten searches of ten trials";
}

TEST_F(ProgressMeterTest, RememberedRunsCountButAreNoMeasureOfSpeed) {
  ProgressMeter meter(200, nullptr, seconds(1), clock_);
  meter.begin(SearchStage::kSearching, 0, 1);
  now_ += seconds(2);
  for (int k = 0; k < 1000; ++k) meter.count_run(false);
  EXPECT_EQ(meter.now().runs, 1000);
  EXPECT_EQ(meter.now().remembered, 1000);
  EXPECT_EQ(meter.now().runs_per_second, 0.0);
  EXPECT_FALSE(meter.now().seconds_left);
}

TEST_F(ProgressMeterTest, ValidatingIsOfRunsAndHasASpeedOfItsOwn) {
  ProgressMeter meter(200, nullptr, seconds(1), clock_);
  compute(&meter, 7);
  meter.begin(SearchStage::kValidating, 1, 50);
  compute(&meter, 20);
  const Progress progress = meter.now();
  EXPECT_EQ(progress.done, 20);
  EXPECT_EQ(progress.of, 50);
  EXPECT_EQ(progress.runs, 27);
  EXPECT_DOUBLE_EQ(progress.runs_per_second, 10.0);
  EXPECT_DOUBLE_EQ(*progress.seconds_left, 3.0);
}

TEST_F(ProgressMeterTest, TellsOncePerPeriodAndAtTheEndOfScreening) {
  int told = 0;
  ProgressMeter meter(
      200, [&told](const Progress&) { ++told; }, seconds(1), clock_);
  meter.begin(SearchStage::kScreening, 3, 1);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(told, 0);
    meter.count_run(true);
    meter.count_point();
  }
  EXPECT_EQ(told, 1);
  now_ += milliseconds(999);
  meter.count_run(true);
  EXPECT_EQ(told, 1);
  now_ += milliseconds(1);
  meter.count_run(true);
  EXPECT_EQ(told, 2);
  meter.end_search(3);
  EXPECT_EQ(told, 2);
  now_ += seconds(5);
  meter.end_search(3);
  EXPECT_EQ(told, 3);
}

TEST(ProgressMeter, ReadsTheSteadyClockUnlessItIsGivenAnother) {
  int told = 0;
  ProgressMeter often(
      200, [&told](const Progress&) { ++told; }, seconds(0));
  often.count_run(true);
  often.end_search(3);
  EXPECT_EQ(told, 2);
  ProgressMeter seldom(
      200, [&told](const Progress&) { ++told; }, std::chrono::hours(10000));
  seldom.count_run(true);
  EXPECT_EQ(told, 2);
}

}  // namespace
}  // namespace codesign
