// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/effort_markers.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

using visualization_msgs::Marker;

/// The sample's hinge, as if it stood at the cart, which is at x = 1, turned by 90 degrees about z. Its effort is 8.
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
  EXPECT_DOUBLE_EQ(style.metres_per_newton_metre, 0.15) << "the largest effort is half as long as the mechanism";
  const ComparedRecording& recording = motion.recordings[0];
  const auto markers =
      effort_markers(motion, recording.measured[0], recording.model[0], {ros::Time(2.0), "identified/ground"}, style).markers;
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].ns, "hinge/identified");
  EXPECT_EQ(markers[1].ns, "hinge/measured");
  const double along[] = {0.15 * 8.0, 0.15 * -10.0};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(markers[k].header.frame_id, "identified/ground");
    ASSERT_EQ(markers[k].points.size(), 2U);
    EXPECT_NEAR(markers[k].points[1].x, markers[k].points[0].x, 1e-12) << "the cart's x axis is the world's y axis";
    const Eigen::Vector3d beside(markers[k].points[0].x - 1.0, markers[k].points[0].y, markers[k].points[0].z);
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
  const auto markers = effort_markers(motion, motion.recordings[0].measured[0], motion.recordings[0].model[0], {}, style).markers;
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
    const auto markers = effort_markers(motion, recording.measured[0], recording.model[0], {ros::Time(2.0), "ground"}, style).markers;
    EXPECT_EQ(markers[0].points[0], markers[1].points[0]) << "both begin in the same place";
    return std::make_pair(markers[0].points[0].y, markers[0].points[1].y);
  };
  // The effort of 8 along y is 1.2 m long; the solid ends at y = 1 and y = -1.
  EXPECT_NEAR(ends_at(1.0).first, 1.0, 1e-12);
  EXPECT_NEAR(ends_at(1.0).second, 2.2, 1e-12);
  EXPECT_NEAR(ends_at(-1.0).second, -1.0, 1e-12) << "it points away from the viewer and ends at the solid";
}

TEST(EffortLegend, TellsScaleAndColors) {
  const ComparedMotion motion = sample_motion();
  const auto lines = effort_legend(effort_style(motion, 3.0), motion);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].text, "effort of the model, 0.15 m per N m");
  EXPECT_EQ(lines[1].text, "effort measured");
  EXPECT_TRUE(effort_legend(MarkerStyle(), ComparedMotion()).empty());
}

}  // namespace
}  // namespace codesign
