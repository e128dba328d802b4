// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/friction_markers.h"

#include <gtest/gtest.h>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

const MessageContext kMarkerContext{ros::Time(1.0), "ground"};
constexpr MarkerStyle kStyle{0.05, 0.25, 0.01};

TEST(FrictionMarkers, AnArrowStartsAtTheJointAndIsAsLongAsTheForceIsLarge) {
  const auto message = friction_markers(sample_names(), sample_frame(0.0), kMarkerContext, kStyle);
  ASSERT_EQ(message.markers.size(), 2U);
  const auto& force = message.markers[0];
  EXPECT_EQ(force.header.frame_id, "ground");
  EXPECT_EQ(force.ns, "cart_joint");
  EXPECT_EQ(force.type, visualization_msgs::Marker::ARROW);
  EXPECT_EQ(force.action, visualization_msgs::Marker::ADD);
  ASSERT_EQ(force.points.size(), 2U);
  EXPECT_DOUBLE_EQ(force.points[0].x, 0.1);
  EXPECT_DOUBLE_EQ(force.points[1].x, 0.1 + 4.0 * 0.05);
  EXPECT_DOUBLE_EQ(force.points[1].y, 0.2);
  EXPECT_DOUBLE_EQ(force.scale.x, 0.01);
}

TEST(FrictionMarkers, ATorqueIsDrawnAlongItsAxisInAnotherColour) {
  const auto message = friction_markers(sample_names(), sample_frame(0.0), kMarkerContext, kStyle);
  const auto& torque = message.markers[1];
  EXPECT_DOUBLE_EQ(torque.points[1].z, 0.6 - 2.0 * 0.25);
  EXPECT_NE(torque.color.b, message.markers[0].color.b);
}

TEST(FrictionMarkers, AnArrowTooShortToSeeIsTakenAway) {
  Frame frame = sample_frame(0.0);
  frame.frictions[0].force = {0.19, 0.0, 0.0};
  EXPECT_EQ(friction_markers(sample_names(), frame, kMarkerContext, kStyle).markers[0].action, visualization_msgs::Marker::DELETE);
  frame.frictions[0].force = {0.21, 0.0, 0.0};
  EXPECT_EQ(friction_markers(sample_names(), frame, kMarkerContext, kStyle).markers[0].action, visualization_msgs::Marker::ADD);
}

}  // namespace
}  // namespace codesign
