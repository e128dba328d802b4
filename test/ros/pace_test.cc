// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/pace.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

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

}  // namespace
}  // namespace codesign
