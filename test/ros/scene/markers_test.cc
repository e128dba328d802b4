// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene/markers.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>

#include "identification/comparison/compared_motion.h"
#include "ros/sample_frame.h"

namespace codesign {
namespace {

using visualization_msgs::Marker;

/// The sample's hinge, as if it stood at the cart, which is at x = 1, turned by 90 degrees about z.
/// Its effort is 8.
ComparedMotion sample_motion() {
  ComparedMotion motion;
  motion.names = sample_names();
  motion.joints = {{1, 1, Eigen::Vector3d::UnitX(), true}};
  motion.recordings = {{"identify.data[0]", {sample_frame(0.0)}, {sample_frame(0.0)}, {}}};
  motion.recordings[0].measured[0].joints[1].effort = -10.0;
  return motion;
}

TEST(EffortMarkers, BothEffortsAlongTheJointsAxis) {
  const ComparedMotion motion = sample_motion();
  const MarkerStyle style = effort_style(motion, 3.0);
  EXPECT_DOUBLE_EQ(style.metres_per_newton_metre, 0.15)
      << "the largest effort is half as long as the mechanism";
  const ComparedRecording& recording = motion.recordings[0];
  const auto markers = effort_markers(motion, recording.measured[0], recording.model[0],
                                      {ros::Time(2.0), "identified/ground"}, style)
                           .markers;
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].ns, "hinge/identified");
  EXPECT_EQ(markers[1].ns, "hinge/measured");
  const double along[] = {0.15 * 8.0, 0.15 * -10.0};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(markers[k].header.frame_id, "identified/ground");
    ASSERT_EQ(markers[k].points.size(), 2U);
    EXPECT_NEAR(markers[k].points[1].x, markers[k].points[0].x, 1e-12)
        << "the cart's x axis is the world's y axis";
    const Eigen::Vector3d beside(markers[k].points[0].x - 1.0, markers[k].points[0].y,
                                 markers[k].points[0].z);
    EXPECT_NEAR(beside.norm(), 4.0 * style.shaft_diameter, 1e-12);
    EXPECT_NEAR(beside.y(), 0.0, 1e-12);
    EXPECT_NEAR(markers[k].points[1].y - markers[k].points[0].y, along[k], 1e-12);
  }
  EXPECT_GT(markers[1].scale.x, markers[0].scale.x);
  EXPECT_LT(markers[1].color.a, 1.0F);
}

TEST(EffortMarkers, AnEffortThatIsNotKnownHasNoArrow) {
  ComparedMotion motion = sample_motion();
  motion.recordings[0].measured[0].joints[1].effort = std::numeric_limits<double>::quiet_NaN();
  const MarkerStyle style = effort_style(motion, 3.0);
  EXPECT_DOUBLE_EQ(style.metres_per_newton_metre, 1.5 / 8.0);
  const auto markers = effort_markers(motion, motion.recordings[0].measured[0],
                                      motion.recordings[0].model[0], {}, style)
                           .markers;
  EXPECT_EQ(markers[0].action, Marker::ADD);
  EXPECT_EQ(markers[1].action, Marker::DELETE);
}

TEST(EffortMarkers, BothArrowsStandOutsideOfTheSolidsOnTheViewersSide) {
  ComparedMotion motion = sample_motion();
  motion.recordings[0].measured[0].joints[1].effort = 10.0;
  MarkerStyle style = effort_style(motion, 3.0);
  LinkBoxes boxes(3);
  boxes[1].push_back({Eigen::Isometry3d::Identity(), {1.0, 1.0, 1.0}});
  style.solids = std::make_shared<LinkBoxes>(boxes);
  const ComparedRecording& recording = motion.recordings[0];
  const auto ends_at = [&](double y) {
    style.towards_viewer = {0.0, y, 0.0};
    const auto markers = effort_markers(motion, recording.measured[0], recording.model[0],
                                        {ros::Time(2.0), "ground"}, style)
                             .markers;
    EXPECT_EQ(markers[0].points[0], markers[1].points[0]) << "both begin in the same place";
    return std::make_pair(markers[0].points[0].y, markers[0].points[1].y);
  };
  // The effort of 8 along y is 1.2 m long; the solid ends at y = 1 and y = -1.
  EXPECT_NEAR(ends_at(1.0).first, 1.0, 1e-12);
  EXPECT_NEAR(ends_at(1.0).second, 2.2, 1e-12);
  EXPECT_NEAR(ends_at(-1.0).second, -1.0, 1e-12)
      << "it points away from the viewer and ends at the solid";
}

TEST(EffortLegend, TellsScaleAndColors) {
  const ComparedMotion motion = sample_motion();
  const auto lines = effort_legend(effort_style(motion, 3.0), motion);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text, "effort of the model, 0.15 m per N m");
  EXPECT_EQ(lines[1].text, "effort measured");
  EXPECT_TRUE(effort_legend(MarkerStyle(), ComparedMotion()).empty());
}

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
  EXPECT_EQ(friction_markers(sample_names(), frame, kMarkerContext, kStyle).markers[0].action,
            visualization_msgs::Marker::DELETE);
  frame.frictions[0].force = {0.21, 0.0, 0.0};
  EXPECT_EQ(friction_markers(sample_names(), frame, kMarkerContext, kStyle).markers[0].action,
            visualization_msgs::Marker::ADD);
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
  // The ray (0, -0.8, 0.6) leaves the cube at y = -1; half of the head, 1.25 shaft diameters, and a
  // little more lie between.
  EXPECT_NEAR(ends.from.y(), -1.0 - 0.8 * 0.015, 1e-12);
  EXPECT_NEAR(ends.from.z(), 0.75 + 0.6 * 0.015, 1e-12);
  EXPECT_NEAR(ends.from.x(), 1.0, 1e-12) << "it moves at a right angle to itself";
  EXPECT_TRUE((ends.to - ends.from).isApprox(Eigen::Vector3d(0.2, 0.0, 0.0), 1e-12))
      << "as long as before";
  frame_.frictions[0].force *= -1.0;
  EXPECT_TRUE(friction_arrow(frame_.frictions[0], false, frame_, style_).from.isApprox(ends.from))
      << "the same place for both directions";
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

// The plate's cube stands before the cart's, with a gap that is wider than the shaft and shorter
// than the arrow.
TEST_F(HiddenArrows, ATorqueDoesNotEndInAGapBetweenSolids) {
  LinkBoxes boxes = *style_.solids;
  boxes[0].push_back({Eigen::Isometry3d(Eigen::Translation3d(1.0, -1.5, 0.0)), {0.3, 0.3, 0.3}});
  style_.solids = std::make_shared<LinkBoxes>(boxes);
  FrictionSample& sample = frame_.frictions[1];
  sample.torque = {0.0, 2.0, 0.0};
  const ArrowEnds away = friction_arrow(sample, true, frame_, style_);
  EXPECT_TRUE(away.to.isApprox(Eigen::Vector3d(1.0, -1.8, 0.0), 1e-12))
      << "the tip stands before both: " << away.to.transpose();
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
  EXPECT_EQ(friction_arrow(frame_.frictions[0], false, frame_, style_).from,
            frame_.frictions[0].position);
}

/// A root without solids, and a link at x = 1, turned by 90 degrees about z, with a box of 2 x 4 x
/// 6 m.
Frame turned_frame() {
  Frame frame;
  frame.links.resize(2);
  frame.links[1] = {
      {1.0, 0.0, 0.0},
      Eigen::Quaterniond(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()))};
  return frame;
}

LinkBoxes one_box() {
  LinkBoxes boxes(2);
  boxes[1].push_back({Eigen::Isometry3d::Identity(), {1.0, 2.0, 3.0}});
  return boxes;
}

TEST(WayOut, IsToTheFaceOfTheBoxInTheLinksAxes) {
  const Eigen::Vector3d centre(1.0, 0.0, 0.0);
  EXPECT_NEAR(way_out(centre, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1), 2.0,
              1e-12);
  EXPECT_NEAR(way_out(centre, Eigen::Vector3d::UnitY(), turned_frame(), one_box(), 0.1), 1.0,
              1e-12);
  EXPECT_NEAR(way_out(centre, -Eigen::Vector3d::UnitZ(), turned_frame(), one_box(), 0.1), 3.0,
              1e-12);
}

TEST(WayOut, OutsideItIsZero) {
  EXPECT_EQ(way_out({-1.5, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1),
            0.0)
      << "the box is farther than the clearance";
  EXPECT_EQ(way_out({1.0, 5.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1),
            0.0);
  EXPECT_EQ(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), {}, 0.1), 0.0);
}

TEST(WayOut, BoxesThatTouchOrNearlySoAreLeftTogether) {
  LinkBoxes boxes = one_box();
  boxes[0].push_back({Eigen::Isometry3d(Eigen::Translation3d(4.05, 0.0, 0.0)), {1.0, 1.0, 1.0}});
  EXPECT_NEAR(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), boxes, 0.1), 4.05,
              1e-12);
  EXPECT_NEAR(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), boxes, 0.01), 2.0,
              1e-12)
      << "there is room between them";
}

}  // namespace
}  // namespace codesign
