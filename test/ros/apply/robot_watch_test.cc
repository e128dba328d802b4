// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/robot_watch.h"

#include <gtest/gtest.h>

#include <limits>

#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

TEST(AgeOf, AnyStampHasOne) {
  const ros::Time now(1700000000, 250000000);
  EXPECT_NEAR(age_of(ros::Time(1700000000, 0), now), 0.25, 1e-9);
  EXPECT_NEAR(age_of(ros::Time(1700000001, 0), now), -0.75, 1e-9);
  EXPECT_NEAR(age_of(ros::TIME_MIN, ros::TIME_MAX), 4294967295.0, 2.0);
  EXPECT_NEAR(age_of(ros::TIME_MAX, ros::TIME_MIN), -4294967295.0, 2.0);
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Ranges, OfTheModel) {
  const Problem problem = pendulum_on_hardware();  // continuous, effort 3, velocity 2
  SafeRanges ranges;
  ranges.add_limits_of(problem, problem.parameters());
  EXPECT_EQ(ranges.check("hinge/effort", -3.0), "");
  EXPECT_EQ(ranges.check("hinge/effort", -3.5),
            "hinge/effort is -3.5, outside -3 to 3, the limit of the model");
  EXPECT_NE(ranges.check("hinge/velocity", 2.5), "");
  EXPECT_EQ(ranges.check("hinge/position", 100.0), "") << "a continuous joint has no stops";
  EXPECT_EQ(ranges.check("hinge/effort", kNotANumber), "") << "not measured";
  EXPECT_TRUE(ranges.joint_signals().empty());
}

TEST(Ranges, OneThatIsGivenReplacesThatOfTheModel) {
  const Problem problem = pendulum_on_hardware();
  SafeRanges ranges;
  ranges.add("hinge/effort=-9:4", "limits");
  ranges.add_limits_of(problem, problem.parameters());
  ranges.add("/drive/temperature=:80", "limits");
  EXPECT_EQ(ranges.check("hinge/effort", -8.0), "");
  EXPECT_EQ(ranges.check("hinge/effort", 4.5), "hinge/effort is 4.5, outside -9 to 4");
  EXPECT_NE(ranges.check("hinge/effort", kNotANumber), "");
  EXPECT_EQ(ranges.check("/drive/temperature", -300.0), "");
  EXPECT_NE(ranges.check("/drive/temperature", 80.5), "");
  EXPECT_EQ(ranges.joint_signals(), (std::vector<std::string>{"hinge/effort"}));
  EXPECT_EQ(ranges.topics(), (std::vector<std::string>{"/drive/temperature"}));
}

TEST(Ranges, AnotherTextIsRefused) {
  SafeRanges ranges;
  for (const char* text :
       {"", "hinge/effort", "hinge/effort=1", "=1:2", "hinge/effort=2:1", "hinge/effort=a:1",
        "hinge/effort=nan:1", "hinge/power=0:1", "hinge=0:1", "hinge/effort=0:1:2"})
    EXPECT_THROW(ranges.add(text, "limits"), InputError) << text;
}

}  // namespace
}  // namespace codesign
