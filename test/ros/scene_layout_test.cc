// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/scene_layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ros/sample_frame.h"

namespace codesign {
namespace {

std::vector<Frame> sample_run(double force) {
  std::vector<Frame> run{sample_frame(0.0), sample_frame(0.1)};
  run[1].frictions[0].force = {0.0, force, 0.0};
  return run;
}

SceneLayout lay_out_both(const std::vector<Frame>& first, const std::vector<Frame>& second) { return lay_out({&first, &second}); }

TEST(LayOut, TheMechanismsStandClearOfEachOther) {
  // The sample's links span 1 m along x and 2 m along y.
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(1.0), sample_run(1.0)).separation, 2.0 + 0.5 * 2.0);
}

TEST(LayOut, ATypicalArrowOfBothRunsIsAThirdOfTheMechanism) {
  // Forces of 4, 3, 4 and 5 N, whose mean square is 16.5; torques of 2 N m throughout.
  const SceneLayout layout = lay_out_both(sample_run(3.0), sample_run(5.0));
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton * std::sqrt(16.5), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(layout.style.metres_per_newton_metre * 2.0, 2.0 / 3.0);
}

TEST(LayOut, TheArrowOfAPeakIsNotLongerThanTheMechanism) {
  std::vector<Frame> peaked = sample_run(1e3);
  peaked.resize(100, sample_frame(0.0));
  EXPECT_DOUBLE_EQ(lay_out_both(sample_run(3.0), peaked).style.metres_per_newton * 1e3, 2.0);
}

TEST(LayOut, WithoutFramesItStaysFinite) {
  const SceneLayout layout = lay_out({});
  EXPECT_GT(layout.style.shaft_diameter, 0.0);
  EXPECT_TRUE(std::isfinite(layout.style.metres_per_newton));
}

TEST(Label, StandsAboveItsFrame) {
  SceneLayout layout;
  layout.label_height = 0.7;
  const visualization_msgs::Marker marker = label("recording", "world", "identify.data[0]", layout, ros::Time(1.0));
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_EQ(marker.text, "identify.data[0]");
  EXPECT_EQ(marker.pose.position.z, 0.7);
}

}  // namespace
}  // namespace codesign
