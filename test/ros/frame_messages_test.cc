// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/frame_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

TEST(FrameMessages, EveryTopicOnceAndAllOfOneInstant) {
  const MessageContext context{ros::Time(12.5), "ground"};
  const FrameMessages messages(sample_names(), sample_frame(2.0), context, MarkerStyle());
  std::vector<std::string> topics;
  messages.visit([&topics](const std::string& topic, const auto&) { topics.push_back(topic); });
  EXPECT_EQ(topics, (std::vector<std::string>{"joint_states", "joint_friction", "controller_states", "loop_errors", "signals",
                                              "friction_markers"}));
  EXPECT_EQ(messages.joint_states.header.stamp, context.stamp);
  EXPECT_EQ(messages.joint_friction.header.stamp, context.stamp);
  EXPECT_EQ(messages.controller_states.header.stamp, context.stamp);
  EXPECT_EQ(messages.loop_errors.header.stamp, context.stamp);
  EXPECT_EQ(messages.joint_states.name.size(), 2U) << "the joints of the tree";
  EXPECT_EQ(messages.friction_markers.markers.size(), 2U);
  for (const auto& marker : messages.friction_markers.markers) {
    EXPECT_EQ(marker.header.stamp, context.stamp);
    EXPECT_EQ(marker.header.frame_id, "ground");
  }
}

}  // namespace
}  // namespace codesign
