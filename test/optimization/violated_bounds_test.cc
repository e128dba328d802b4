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
      "no point was found that keeps the bounds of all signals: constraints[1] (slide/effort) goes from -3 to 2, beyond its bounds by 1.5");
}

}  // namespace
}  // namespace codesign
