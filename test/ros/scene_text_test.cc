// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_text.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(ArrowLegend, TellsScaleAndColorOfTheArrowsThatAreDrawn) {
  SceneLayout layout;
  EXPECT_TRUE(arrow_legend(layout).empty());
  layout.has_forces = layout.has_torques = true;
  layout.style.metres_per_newton = 0.021;
  layout.style.metres_per_newton_metre = 0.5;
  const std::vector<CaptionLine> lines = arrow_legend(layout);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text, "friction force, 0.021 m per N");
  EXPECT_EQ(lines[0].color, friction_color(false));
  EXPECT_EQ(lines[1].text, "friction torque, 0.5 m per N m");
  EXPECT_EQ(lines[1].color, friction_color(true));
  layout.style.metres_per_newton_metre = 840.0;
  EXPECT_EQ(arrow_legend(layout)[1].text, "friction torque, 840 m per N m");
  layout.style.longest = 0.25;
  EXPECT_EQ(arrow_legend(layout)[0].text, "friction force, 0.021 m per N, at most 0.25 m");
}

TEST(Caption, HasItsLinesOneBelowTheOtherInThePicture) {
  SceneLayout layout;
  layout.letter = 0.1;
  const auto message = caption({plain_line("t = 1 s"), {"red", friction_color(false)}}, layout, {1.0, 2.0, 3.0}, {ros::Time(2.0), "world"});
  ASSERT_EQ(message.markers.size(), 2U);
  EXPECT_EQ(message.markers[0].text, "t = 1 s");
  EXPECT_EQ(message.markers[0].type, visualization_msgs::Marker::TEXT_VIEW_FACING);
  EXPECT_EQ(message.markers[0].pose.position.z, 3.0);
  EXPECT_LT(message.markers[1].pose.position.z, 3.0 - 0.1);
  EXPECT_NE(message.markers[0].id, message.markers[1].id);
  EXPECT_EQ(message.markers[1].header.frame_id, "world");
  EXPECT_EQ(message.markers[1].color, friction_color(false));
  EXPECT_EQ(message.markers[1].scale.z, 0.1);
}

TEST(Label, StandsAboveItsMechanism) {
  Stage stage;
  stage.label = {0.1, 0.2, 0.7};
  stage.letter = 0.05;
  const visualization_msgs::Marker marker = label("recording", "world", "identify.data[0]", stage, ros::Time(1.0));
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_EQ(marker.text, "identify.data[0]");
  EXPECT_EQ(marker.pose.position.z, 0.7);
  EXPECT_EQ(marker.scale.z, 0.05);
}

TEST(PlaceInWorld, IsATransformFromWorld) {
  const auto transform = place_in_world("tuned", {1.0, 2.0, 3.0}, ros::Time(1.0));
  EXPECT_EQ(transform.header.frame_id, "world");
  EXPECT_EQ(transform.child_frame_id, "tuned");
  EXPECT_EQ(transform.transform.translation.y, 2.0);
  EXPECT_EQ(transform.transform.rotation.w, 1.0);
}

}  // namespace
}  // namespace codesign
