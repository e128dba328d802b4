// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(PlainNumbers, WhatIsMissingOrNoNumberIsZero) {
  tinyxml2::XMLDocument document;
  document.Parse("<a n='2.5' bad='two' v='1 two 3 4'/>");
  const tinyxml2::XMLElement* a = document.RootElement();
  EXPECT_EQ(plain_number(a, "n"), 2.5);
  EXPECT_EQ(plain_number(a, "bad"), 0.0);
  EXPECT_EQ(plain_number(a, "missing"), 0.0);
  EXPECT_EQ(plain_number(nullptr, "n"), 0.0);
  EXPECT_EQ(plain_vector(a, "v"), Eigen::Vector3d(1.0, 0.0, 3.0));
  EXPECT_EQ(plain_vector(nullptr, "v"), Eigen::Vector3d(0.0, 0.0, 0.0));
}

TEST(PlainOrigin, TurnsAboutFixedAxesXThenYThenZ) {
  tinyxml2::XMLDocument document;
  document.Parse(
      "<visual><origin xyz='1 2 3' rpy='1.5707963267948966 0 1.5707963267948966'/></visual>");
  // About x the y axis becomes z, which the turn about z leaves.
  const Eigen::Isometry3d pose = plain_origin(document.RootElement());
  EXPECT_TRUE(
      (pose * Eigen::Vector3d(0.0, 1.0, 0.0)).isApprox(Eigen::Vector3d(1.0, 2.0, 4.0), 1e-12));
  EXPECT_TRUE(plain_origin(document.RootElement()->FirstChildElement()).isApprox(pose))
      << "an element with its own xyz and rpy";
  EXPECT_TRUE(plain_origin(nullptr).isApprox(Eigen::Isometry3d::Identity()));
}

constexpr const char* kSolids = R"(<robot name="solids">
  <link name="b"><visual><origin xyz="0 0 1"/><geometry><box size="2 4 6"/></geometry></visual>
    <visual><geometry><sphere radius="0.5"/></geometry></visual></link>
  <link name="a"><visual><geometry><cylinder radius="0.25" length="3"/></geometry></visual>
    <visual><geometry><mesh filename="package://x.stl"/></geometry></visual></link>
  <link name="not asked for"><visual><geometry><sphere radius="9"/></geometry></visual></link>
</robot>)";

TEST(LinkBoxes, OfEachSolidInTheOrderOfTheNames) {
  const LinkBoxes boxes = link_boxes(kSolids, {"a", "b", "without"});
  ASSERT_EQ(boxes.size(), 3U);
  ASSERT_EQ(boxes[0].size(), 1U) << "the size of a mesh is not known";
  EXPECT_EQ(boxes[0][0].half, Eigen::Vector3d(0.25, 0.25, 1.5));
  ASSERT_EQ(boxes[1].size(), 2U);
  EXPECT_EQ(boxes[1][0].half, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(boxes[1][0].pose.translation(), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(boxes[1][1].half, Eigen::Vector3d(0.5, 0.5, 0.5));
  EXPECT_TRUE(boxes[2].empty());
}

TEST(LinkBoxes, OfWhatIsNoUrdfThereAreNone) {
  for (const char* text : {"", "no XML", "<robot/>"})
    EXPECT_TRUE(link_boxes(text, {"a"}).at(0).empty()) << text;
}

}  // namespace
}  // namespace codesign
