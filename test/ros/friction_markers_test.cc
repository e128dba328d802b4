// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/friction_markers.h"

#include <gtest/gtest.h>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

const MessageContext kMarkerContext{ros::Time(1.0), "ground"};
const MarkerStyle kStyle{0.05, 0.25, 0.01};

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

/// The sample with a cube of 2 m around the cart's origin at x = 1, and frictions in its middle.
class HiddenArrows : public testing::Test {
 protected:
  HiddenArrows() {
    LinkBoxes boxes(3);
    boxes[1].push_back({Eigen::Isometry3d::Identity(), {1.0, 1.0, 1.0}});
    style_.solids = std::make_shared<LinkBoxes>(boxes);
    for (FrictionSample& sample : frame_.frictions) sample.position = {1.0, 0.0, 0.0};
  }

  Frame frame_ = sample_frame(0.0);
  // The viewer stands at -y and a little above; 0.05 m/N and 0.25 m/(N m).
  MarkerStyle style_{0.05, 0.25, 0.01, Eigen::Vector3d(0.0, -0.8, 0.6), nullptr};
};

TEST_F(HiddenArrows, AForceIsDrawnBesideTheSolidTowardsTheViewer) {
  const ArrowEnds ends = friction_arrow(frame_.frictions[0], false, frame_, style_);
  // The ray (0, -0.8, 0.6) leaves the cube at y = -1; half of the head, 1.25 shaft diameters, and a little more lie between.
  EXPECT_NEAR(ends.from.y(), -1.0 - 0.8 * 0.015, 1e-12);
  EXPECT_NEAR(ends.from.z(), 0.75 + 0.6 * 0.015, 1e-12);
  EXPECT_NEAR(ends.from.x(), 1.0, 1e-12) << "it moves at a right angle to itself";
  EXPECT_TRUE((ends.to - ends.from).isApprox(Eigen::Vector3d(0.2, 0.0, 0.0), 1e-12)) << "as long as before";
  frame_.frictions[0].force *= -1.0;
  EXPECT_TRUE(friction_arrow(frame_.frictions[0], false, frame_, style_).from.isApprox(ends.from)) << "the same place for both directions";
}

TEST_F(HiddenArrows, ATorqueIsDrawnAlongItsAxisOnTheViewersSide) {
  FrictionSample& sample = frame_.frictions[1];
  sample.torque = {0.0, -2.0, 0.0};
  const ArrowEnds towards = friction_arrow(sample, true, frame_, style_);
  EXPECT_TRUE(towards.from.isApprox(Eigen::Vector3d(1.0, -1.0, 0.0), 1e-12));
  EXPECT_TRUE(towards.to.isApprox(Eigen::Vector3d(1.0, -1.5, 0.0), 1e-12));
  sample.torque = {0.0, 2.0, 0.0};
  const ArrowEnds away = friction_arrow(sample, true, frame_, style_);
  EXPECT_TRUE(away.from.isApprox(towards.to, 1e-12)) << "in the same place, turned round";
  EXPECT_TRUE(away.to.isApprox(towards.from, 1e-12));
}

// The plate's cube stands before the cart's, with a gap that is wider than the shaft and shorter than the arrow.
TEST_F(HiddenArrows, ATorqueDoesNotEndInAGapBetweenSolids) {
  LinkBoxes boxes = *style_.solids;
  boxes[0].push_back({Eigen::Isometry3d(Eigen::Translation3d(1.0, -1.5, 0.0)), {0.3, 0.3, 0.3}});
  style_.solids = std::make_shared<LinkBoxes>(boxes);
  FrictionSample& sample = frame_.frictions[1];
  sample.torque = {0.0, 2.0, 0.0};
  const ArrowEnds away = friction_arrow(sample, true, frame_, style_);
  EXPECT_TRUE(away.to.isApprox(Eigen::Vector3d(1.0, -1.8, 0.0), 1e-12)) << "the tip stands before both: " << away.to.transpose();
}

TEST(FrictionMarkers, ALongArrowIsCut) {
  MarkerStyle style = kStyle;
  style.longest = 0.1;
  const Frame frame = sample_frame(0.0);
  const ArrowEnds ends = friction_arrow(frame.frictions[0], false, frame, style);
  EXPECT_TRUE((ends.to - ends.from).isApprox(Eigen::Vector3d(0.1, 0.0, 0.0), 1e-12));
}

TEST_F(HiddenArrows, NothingMovesWhereNothingHides) {
  frame_.frictions[0].position = {5.0, 5.0, 5.0};
  EXPECT_EQ(friction_arrow(frame_.frictions[0], false, frame_, style_).from, frame_.frictions[0].position);
}

}  // namespace
}  // namespace codesign
