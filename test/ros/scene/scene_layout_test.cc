// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/scene_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "description/expression.h"
#include "ros/sample_frame.h"

namespace codesign {
namespace {

std::vector<Frame> sample_run(double force) {
  std::vector<Frame> run{sample_frame(0.0), sample_frame(0.1)};
  run[1].frictions[0].force = {0.0, force, 0.0};
  return run;
}

SceneLayout lay_out_both(const std::vector<Frame>& first, const std::vector<Frame>& second,
                         const LinkBoxes& boxes = LinkBoxes(3)) {
  static const FrameNames kNames = sample_names();
  const auto solids = std::make_shared<LinkBoxes>(boxes);
  return lay_out({{kNames, first, solids}, {kNames, second, solids}});
}

TEST(LayOut, TheExtentIsThatOfLinksAndTheirSolids) {
  // The sample's links span 1 m along x and 2 m along y.
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(1.0), sample_run(1.0)).size, 2.0);
  LinkBoxes boxes(3);
  boxes[2].push_back({Eigen::Isometry3d::Identity(), {0.1, 0.3, 4.0}});
  const SceneLayout tall = lay_out_both(sample_run(1.0), sample_run(1.0), boxes);
  EXPECT_DOUBLE_EQ(tall.size, 8.0);
  EXPECT_DOUBLE_EQ(tall.floor, -4.0);
}

TEST(LayOut, AFloorCountsAsFarAsHalfASizeAroundWhatMoves) {
  LinkBoxes boxes(3);
  boxes[0].push_back({Eigen::Isometry3d::Identity(), {100.0, 100.0, 0.25}});
  const SceneLayout layout = lay_out_both(sample_run(1.0), sample_run(1.0), boxes);
  EXPECT_DOUBLE_EQ(layout.size, 2.0 + 2.0 * 0.5 * 2.0);
  EXPECT_DOUBLE_EQ(layout.floor, -0.25);
}

TEST(LayOut, ATypicalArrowIsASixthOfTheMechanismInTwoDigits) {
  // Forces of 4, 3, 4 and 5 N, whose median is 4 N; torques of 2 N m throughout.
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton, 0.083) << "a third of a metre over 4 N";
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton_metre, 0.16);
  EXPECT_TRUE(layout.has_forces);
  EXPECT_TRUE(layout.has_torques);
}

// The governor's friction decays by seven orders of magnitude within its run.
TEST(LayOut, APeakNeitherHidesTheOtherArrowsNorGetsLongerThanFourTenthsOfTheMechanism) {
  std::vector<Frame> peaked = sample_run(1e3);
  peaked.resize(100, sample_frame(0.0));
  const SceneLayout layout = lay_out_both(sample_run(3.0), peaked);
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton, 0.083);
  EXPECT_DOUBLE_EQ(layout.style.longest, 0.4 * layout.size);
  for (Frame& frame : peaked) frame.frictions[0].force *= 1e-9;
  peaked.front().frictions[0].force = {0.0, 4.0, 0.0};
  EXPECT_LT(lay_out_both(peaked, peaked).style.metres_per_newton, 0.1)
      << "what is nearly nothing does not count";
}

TEST(LayOut, ArrowsAreToBeSeen) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(-5.0));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : layout.points) box.extend(point);
  EXPECT_LE(box.min().y(), 0.2 - 5.0 * layout.style.metres_per_newton + 1e-12);
  EXPECT_GE(box.max().x(), 0.1 + 4.0 * layout.style.metres_per_newton - 1e-12);
}

TEST(LayOut, WithoutFramesItStaysFinite) {
  const FrameNames names = sample_names();
  const std::vector<Frame> none;
  for (const SceneLayout& layout : {lay_out({}), lay_out({{names, none, nullptr}})}) {
    EXPECT_GT(layout.style.shaft_diameter, 0.0);
    EXPECT_GT(layout.letter, 0.0);
    EXPECT_TRUE(std::isfinite(layout.style.metres_per_newton));
    EXPECT_TRUE(std::isfinite(stage_of(layout, {Eigen::Vector3d::Zero()}, 3).scene.distance));
  }
}

TEST(LayOut, AFrameThatIsNotFiniteDoesNotCount) {
  std::vector<Frame> broken = sample_run(1.0);
  broken[1].links[1].position.setConstant(std::nan(""));
  broken[1].frictions[0].force.setConstant(std::nan(""));
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(1.0), broken).size, 2.0);
}

TEST(LayOut, ThePicturesOfBothMechanismsDoNotOverlap) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& point : layout.points) moved.push_back(point + layout.apart);
  EXPECT_FALSE(layout.view.picture(layout.points).intersects(layout.view.picture(moved)));
  EXPECT_EQ(layout.apart.z(), 0.0) << "both stand on the ground";
}

/// Where rviz draws a point, from the middle of the picture to the right and up; 1 is the upper
/// edge.
Eigen::Vector2d drawn_at(const Eigen::Vector3d& point, const mechanism_codesign::Scene& scene) {
  const SceneView view{scene.yaw, scene.pitch};
  const Eigen::Vector3d focus(scene.focal_point[0], scene.focal_point[1], scene.focal_point[2]);
  const Eigen::Vector3d from = point - focus;
  const double away = (scene.distance - from.dot(view.towards_viewer())) * kHalfHeight;
  return {from.dot(view.right()) / away, from.dot(view.up()) / away};
}

TEST(StageOf, MechanismsArrowsAndNamesAreInThePictureBelowTheText) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  const Eigen::Vector3d half = 0.5 * layout.apart, none = Eigen::Vector3d::Zero();
  for (const std::vector<Eigen::Vector3d>& places :
       {std::vector<Eigen::Vector3d>{none}, std::vector<Eigen::Vector3d>{-half, half}}) {
    const Stage stage = stage_of(layout, places, 3);
    const double letter = 1.0 / 18.0, text = drawn_at(stage.caption, stage.scene).y();
    EXPECT_LE(text + 0.5 * letter, 0.93);
    double highest = -1.0, widest = 0.0;
    for (const Eigen::Vector3d& place : places) {
      for (const Eigen::Vector3d& point : layout.points) {
        const Eigen::Vector2d seen = drawn_at(place + point, stage.scene);
        highest = std::max(highest, seen.y());
        widest = std::max(widest, std::abs(seen.x()));
        EXPECT_GE(seen.y(), -0.925);
      }
      const double name = drawn_at(place + stage.label, stage.scene).y();
      EXPECT_LT(name + 0.5 * letter, text - (2.0 * 1.6 + 0.5) * letter) << "below the third line";
    }
    EXPECT_LE(widest, 0.925 * kAspect);
    EXPECT_LT(highest, text - 3.0 * 1.6 * letter);
    EXPECT_TRUE(widest > 0.8 * kAspect || highest > 0.3) << "the picture is used";
    EXPECT_EQ(stage.scene.grid_cell, 0.2);
    EXPECT_EQ(stage.scene.metres_per_newton, layout.style.metres_per_newton);
  }
}

TEST(StageOf, LettersOfTextAndNamesLookTheSame) {
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  const Stage stage = stage_of(layout, {Eigen::Vector3d::Zero()}, 3);
  const SceneView view{stage.scene.yaw, stage.scene.pitch};
  const Eigen::Vector3d focus(stage.scene.focal_point[0], stage.scene.focal_point[1],
                              stage.scene.focal_point[2]);
  const double away = stage.scene.distance - (stage.caption - focus).dot(view.towards_viewer());
  EXPECT_NEAR(layout.letter / away, stage.letter / stage.scene.distance, 1e-12);
}

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
  const auto message = caption({plain_line("t = 1 s"), {"red", friction_color(false)}}, layout,
                               {1.0, 2.0, 3.0}, {ros::Time(2.0), "world"});
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
  const visualization_msgs::Marker marker =
      label("recording", "world", "identify.data[0]", stage, ros::Time(1.0));
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
