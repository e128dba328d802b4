// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/way_out.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// A root without solids, and a link at x = 1, turned by 90 degrees about z, with a box of 2 x 4 x 6 m.
Frame turned_frame() {
  Frame frame;
  frame.links.resize(2);
  frame.links[1] = {{1.0, 0.0, 0.0}, Eigen::Quaterniond(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()))};
  return frame;
}

LinkBoxes one_box() {
  LinkBoxes boxes(2);
  boxes[1].push_back({Eigen::Isometry3d::Identity(), {1.0, 2.0, 3.0}});
  return boxes;
}

TEST(WayOut, IsToTheFaceOfTheBoxInTheLinksAxes) {
  const Eigen::Vector3d centre(1.0, 0.0, 0.0);
  EXPECT_NEAR(way_out(centre, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1), 2.0, 1e-12);
  EXPECT_NEAR(way_out(centre, Eigen::Vector3d::UnitY(), turned_frame(), one_box(), 0.1), 1.0, 1e-12);
  EXPECT_NEAR(way_out(centre, -Eigen::Vector3d::UnitZ(), turned_frame(), one_box(), 0.1), 3.0, 1e-12);
}

TEST(WayOut, OutsideItIsZero) {
  EXPECT_EQ(way_out({-1.5, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1), 0.0)
      << "the box is farther than the clearance";
  EXPECT_EQ(way_out({1.0, 5.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), one_box(), 0.1), 0.0);
  EXPECT_EQ(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), {}, 0.1), 0.0);
}

TEST(WayOut, BoxesThatTouchOrNearlySoAreLeftTogether) {
  LinkBoxes boxes = one_box();
  boxes[0].push_back({Eigen::Isometry3d(Eigen::Translation3d(4.05, 0.0, 0.0)), {1.0, 1.0, 1.0}});
  EXPECT_NEAR(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), boxes, 0.1), 4.05, 1e-12);
  EXPECT_NEAR(way_out({1.0, 0.0, 0.0}, Eigen::Vector3d::UnitX(), turned_frame(), boxes, 0.01), 2.0, 1e-12) << "there is room between them";
}

}  // namespace
}  // namespace codesign
