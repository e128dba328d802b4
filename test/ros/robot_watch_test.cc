// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/robot_watch.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(AgeOf, AnyStampHasOne) {
  const ros::Time now(1700000000, 250000000);
  EXPECT_NEAR(age_of(ros::Time(1700000000, 0), now), 0.25, 1e-9);
  EXPECT_NEAR(age_of(ros::Time(1700000001, 0), now), -0.75, 1e-9);
  EXPECT_NEAR(age_of(ros::TIME_MIN, ros::TIME_MAX), 4294967295.0, 2.0);
  EXPECT_NEAR(age_of(ros::TIME_MAX, ros::TIME_MIN), -4294967295.0, 2.0);
}

}  // namespace
}  // namespace codesign
