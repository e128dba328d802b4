// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/violated_bounds.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(ViolatedBounds, AreThoseBeyondTheTolerance) {
  WatchedResult met, violated;
  met.element = "path[0]";
  met.violation = 0.5 * kMostViolation;
  violated.element = "constraints[1]";
  violated.signal = "slide/effort";
  violated.smallest = -3.0;
  violated.largest = 2.0;
  violated.violation = 1.5;
  EXPECT_EQ(
      describe_violated({met, violated}),
      "no point was found that keeps the bounds of all signals: constraints[1] (slide/effort) goes from -3 to 2, beyond its bounds by 1.5 "
      "(tolerance: 1e-08)");
}

TEST(ViolatedBounds, TheToleranceFollowsTheRangeOfSignalAndBounds) {
  WatchedResult swing;
  EXPECT_EQ(tolerance_of_range(swing), kMostViolation);
  swing.initial_largest = 2.0;
  swing.smallest = -1.0;
  swing.lower = -3.0;
  EXPECT_DOUBLE_EQ(tolerance_of_range(swing), 3e-5) << "an infinite bound has no magnitude";
}

TEST(ViolatedBounds, ARestIsNoViolation) {
  OptimizationResult result;
  EXPECT_TRUE(meets_constraints(result)) << "there are none";
  result.watched.resize(2);
  result.watched[1].violation = 1e-9;
  result.margins = Eigen::Vector2d(0.0, 3.0);
  EXPECT_TRUE(meets_constraints(result));
  result.watched[1].violation = 1e-6;
  EXPECT_FALSE(meets_constraints(result));
  result.watched[1].violation = 0.0;
  result.margins[0] = -1e-3;
  EXPECT_FALSE(meets_constraints(result));
}

}  // namespace
}  // namespace codesign
