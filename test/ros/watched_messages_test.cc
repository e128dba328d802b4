// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/watched_messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Problem watching() {
  return block(
      "path: [{signal: slide/velocity, between: [-2.0, \"${Kp}\"], after: 0.1}]\nfinal: [{signal: slide/position, at_most: 0.6}]\n");
}

TEST(WatchedMessages, TellBoundsAtTheTunedParameters) {
  const std::vector<WatchedResult> watched = {{"path[0]", "slide/velocity", -0.5, 1.0, -0.25, 0.75, 0.3, 0.2, 0.0},
                                              {"final[0]", "slide/position", 0.1, 0.2, 0.7, 0.8, 0.8, 0.8, 0.2}};
  const auto messages = watched_messages(watching(), watched, Eigen::Vector2d(30.0, 5.0));
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].element, "path[0]");
  EXPECT_EQ(messages[0].signal, "slide/velocity");
  EXPECT_EQ(messages[0].lower, -2.0);
  EXPECT_EQ(messages[0].upper, 30.0);
  EXPECT_EQ(messages[0].after, 0.1);
  EXPECT_EQ(messages[0].before, 0.8);
  EXPECT_EQ(messages[0].initial_smallest, -0.5);
  EXPECT_EQ(messages[0].initial_largest, 1.0);
  EXPECT_EQ(messages[0].smallest, -0.25);
  EXPECT_EQ(messages[0].largest, 0.75);
  EXPECT_EQ(messages[0].smallest_time, 0.3);
  EXPECT_EQ(messages[0].largest_time, 0.2);
  EXPECT_EQ(messages[1].lower, -kInfinity);
  EXPECT_EQ(messages[1].upper, 0.6);
  EXPECT_EQ(messages[1].after, 0.8);
  EXPECT_EQ(messages[1].violation, 0.2);
}

TEST(WatchedMessages, AreNoneForAResultWithoutPoint) {
  EXPECT_TRUE(watched_messages(watching(), {}, Eigen::VectorXd()).empty());
  EXPECT_TRUE(watched_messages(block(""), {}, Eigen::Vector2d(1.0, 1.0)).empty());
}

}  // namespace
}  // namespace codesign
