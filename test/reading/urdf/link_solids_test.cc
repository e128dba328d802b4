// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/link_solids.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

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
  for (const char* text : {"", "no XML", "<robot/>"}) EXPECT_TRUE(link_boxes(text, {"a"}).at(0).empty()) << text;
}

}  // namespace
}  // namespace codesign
