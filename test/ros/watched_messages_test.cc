// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/watched_messages.h"

#include <gtest/gtest.h>

#include <limits>

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

WatchedResult watched() {
  WatchedResult result;
  result.element = "path[0]";
  result.signal = "slide/velocity";
  result.lower = -2.0;
  result.after = 0.1;
  result.before = 0.8;
  result.initial_smallest = -0.5;
  result.initial_largest = 1.0;
  result.smallest = -0.25;
  result.largest = 0.75;
  result.smallest_time = 0.3;
  result.largest_time = 0.2;
  result.largest_scenario = 4;
  result.violation = 0.25;
  return result;
}

TEST(WatchedMessages, TellBoundsAndRanges) {
  const auto messages = watched_messages({watched()}, true);
  ASSERT_EQ(messages.size(), 1U);
  const mechanism_codesign::WatchedSignal& message = messages[0];
  EXPECT_EQ(message.element, "path[0]");
  EXPECT_EQ(message.signal, "slide/velocity");
  EXPECT_EQ(message.lower, -2.0);
  EXPECT_EQ(message.upper, kInfinity);
  EXPECT_EQ(message.after, 0.1);
  EXPECT_EQ(message.before, 0.8);
  EXPECT_EQ(message.initial_smallest, -0.5);
  EXPECT_EQ(message.initial_largest, 1.0);
  EXPECT_EQ(message.smallest, -0.25);
  EXPECT_EQ(message.largest, 0.75);
  EXPECT_EQ(message.smallest_time, 0.3);
  EXPECT_EQ(message.largest_time, 0.2);
  EXPECT_EQ(message.smallest_scenario, 1U);
  EXPECT_EQ(message.largest_scenario, 5U);
  EXPECT_EQ(message.violation, 0.25);
}

TEST(WatchedMessages, NameNoScenarioWhereThereIsOne) {
  EXPECT_EQ(watched_messages({watched()}, false).at(0).largest_scenario, 0U);
  EXPECT_TRUE(watched_messages({}, true).empty());
}

}  // namespace
}  // namespace codesign
