// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/run_clock.h"

#include <gtest/gtest.h>

#include <thread>

namespace codesign {
namespace {

TEST(RunClock, FreeRunningLaysRunsEndToEndFromOneSecondOn) {
  RunClock clock(0.0);
  ASSERT_TRUE(clock.is_free_running());
  clock.start_run(0.0);
  EXPECT_EQ(clock.stamp(0.0), ros::Time(1.0));
  EXPECT_EQ(clock.stamp(0.5), ros::Time(1.5));
  clock.start_run(2.25);
  EXPECT_EQ(clock.stamp(0.5), ros::Time(3.75));
}

TEST(RunClock, FreeRunningNeverWaits) {
  RunClock clock(0.0);
  clock.start_run(0.0);
  EXPECT_TRUE(clock.wait(1e9, [] { return false; }));
}

TEST(RunClock, PacedStampsAreScaledRosTime) {
  ros::Time::init();
  const ros::Time before = ros::Time::now();
  RunClock clock(4.0);
  clock.start_run(0.0);
  EXPECT_FALSE(clock.is_free_running());
  EXPECT_GE(clock.stamp(0.0), before);
  EXPECT_NEAR((clock.stamp(2.0) - clock.stamp(0.0)).toSec(), 0.5, 1e-9);
}

TEST(RunClock, PacedWaitsUntilDueAndNoLongerThanAsked) {
  ros::Time::init();
  RunClock clock(100.0);
  const ros::WallTime before = ros::WallTime::now();
  clock.start_run(0.0);
  EXPECT_TRUE(clock.wait(1.0, [] { return false; }));
  EXPECT_GE((ros::WallTime::now() - before).toSec(), 0.00999);
  EXPECT_FALSE(clock.wait(1e9, [] { return true; }));
}

TEST(RunClock, TheTimeOfAStampIsItsInverse) {
  ros::Time::init();
  for (double scale : {0.0, 3.0}) {
    RunClock clock(scale);
    clock.start_run(0.0);
    EXPECT_NEAR(clock.time_of(clock.stamp(1.25)), 1.25, 1e-8);
    EXPECT_NEAR(clock.time_of(clock.stamp(0.0) - ros::Duration(0.5)), scale > 0.0 ? -1.5 : -0.5,
                1e-8);
  }
}

TEST(RunClock, AnyStampHasATime) {
  ros::Time::init();
  for (double scale : {0.0, 1.0}) {
    RunClock clock(scale);
    clock.start_run(0.0);
    EXPECT_GT(clock.time_of(ros::TIME_MAX), 1e9);
    EXPECT_LT(clock.time_of(ros::Time()), 0.0);
  }
}

TEST(RunClock, ARunGoesOnThoughTheClockOfRosStandsAtItsBeginning) {
  ros::Time::init();
  ros::Time::setNow(ros::Time(2.0));
  RunClock clock(1.0);
  clock.start_run(0.0);
  EXPECT_NO_THROW(clock.go_on_from(5.0));
  EXPECT_TRUE(clock.wait(5.0, [] { return false; }));
  ros::Time::useSystemTime();
}

TEST(RunClock, AfterAPauseAPacedRunDoesNotCatchUp) {
  ros::Time::init();
  RunClock clock(1.0);
  clock.start_run(0.0);
  const ros::Time before = ros::Time::now();
  clock.go_on_from(1e6);
  const ros::Time behind = ros::Time::now();
  EXPECT_TRUE(clock.wait(1e6, [] { return false; }));
  EXPECT_LE(clock.time_of(before), 1e6 + 1e-6);
  EXPECT_GE(clock.time_of(behind), 1e6 - 1e-6);
}

TEST(Bell, ARingBeforeTheWaitCounts) {
  Bell bell;
  bell.ring();
  bell.wait(1e6);
}

TEST(Bell, ARingFromAnotherThreadEndsTheWait) {
  Bell bell;
  std::thread other([&bell] { bell.ring(); });
  bell.wait(1e6);
  other.join();
}

TEST(Bell, WithoutARingTheWaitEndsByItself) {
  Bell bell;
  bell.wait(0.01);
  bell.ring();
  bell.wait(1e6);
  bell.wait(0.01);
}

TEST(Pace, KeepsFramesApartOnTheAverage) {
  Pace pace(100.0);
  const ros::WallTime start(1000.0);
  EXPECT_DOUBLE_EQ(pace.wait(start).toSec(), 0.0);
  EXPECT_NEAR(pace.wait(start).toSec(), 0.01, 1e-9);
  EXPECT_NEAR(pace.wait(start + ros::WallDuration(0.015)).toSec(), 0.005, 1e-9);
}

TEST(Pace, DoesNotMakeUpForAFrameThatComesLate) {
  Pace pace(100.0);
  pace.wait(ros::WallTime(1000.0));
  EXPECT_DOUBLE_EQ(pace.wait(ros::WallTime(2000.0)).toSec(), 0.0);
  EXPECT_NEAR(pace.wait(ros::WallTime(2000.0)).toSec(), 0.01, 1e-9);
}

TEST(RealTimeFactor, IsTimeOfTheRunOverWallTime) {
  RealTimeFactor factor;
  factor.start(ros::WallTime(1000.0));
  EXPECT_FALSE(factor.note(1.0, ros::WallTime(1000.25)));
  EXPECT_TRUE(factor.note(4.0, ros::WallTime(1001.0)));
  EXPECT_DOUBLE_EQ(factor.value(), 4.0);
  EXPECT_TRUE(factor.note(5.0, ros::WallTime(1003.0)));
  EXPECT_DOUBLE_EQ(factor.value(), 0.5);
  EXPECT_DOUBLE_EQ(factor.mean(5.0, ros::WallTime(1004.0)), 1.25);
}

TEST(RealTimeFactor, CountsNoPause) {
  RealTimeFactor factor;
  factor.start(ros::WallTime(1000.0));
  EXPECT_TRUE(factor.note(1.0, ros::WallTime(1001.0)));
  factor.leave_out(ros::WallDuration(100.0));
  EXPECT_FALSE(factor.note(1.0, ros::WallTime(1101.0))) << "it is not due sooner";
  EXPECT_TRUE(factor.note(3.0, ros::WallTime(1102.0)));
  EXPECT_DOUBLE_EQ(factor.value(), 2.0);
  EXPECT_DOUBLE_EQ(factor.mean(3.0, ros::WallTime(1102.0)), 1.5);
}

}  // namespace
}  // namespace codesign
