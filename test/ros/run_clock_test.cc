// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/run_clock.h"

#include <gtest/gtest.h>

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
  clock.start_run(0.0);
  const ros::WallTime before = ros::WallTime::now();
  EXPECT_TRUE(clock.wait(1.0, [] { return false; }));
  EXPECT_GE((ros::WallTime::now() - before).toSec(), 0.009);
  EXPECT_FALSE(clock.wait(1e9, [] { return true; }));
}

TEST(RunClock, TheTimeOfAStampIsItsInverse) {
  ros::Time::init();
  for (double scale : {0.0, 3.0}) {
    RunClock clock(scale);
    clock.start_run(0.0);
    EXPECT_NEAR(clock.time_of(clock.stamp(1.25)), 1.25, 1e-8);
    EXPECT_NEAR(clock.time_of(clock.stamp(0.0) - ros::Duration(0.5)), scale > 0.0 ? -1.5 : -0.5, 1e-8);
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
  clock.go_on_from(1e6);
  EXPECT_TRUE(clock.wait(1e6, [] { return false; }));
  EXPECT_NEAR(clock.time_of(ros::Time::now()), 1e6, 60.0);
}

}  // namespace
}  // namespace codesign
