// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/pictures.h"

#include <gtest/gtest.h>

#include <fstream>

#include "reading/urdf/urdf_reader.h"
#include "temporary_directory.h"

namespace codesign {
namespace {

/// A cart on the ground, a rod of 1 m on it, a bob without visual 0.5 m below the rod's end; a tool
/// frame without mass.
constexpr const char* kBare = R"(<robot name="bare" xmlns:codesign="urn:mechanism_codesign">
  <link name="ground"/>
  <joint name="travel" type="prismatic"><parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="swing" type="continuous"><parent link="cart"/><child link="rod"/><axis xyz="0 1 0"/></joint>
  <link name="rod"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="knee" type="continuous"><parent link="rod"/><child link="bob"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
  <link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="mount" type="fixed"><parent link="bob"/><child link="tool"/></joint>
  <link name="tool"/>
</robot>)";

TEST(Sticks, RunBetweenTheFramesOfJointsAndToTheLastCentreOfMass) {
  const LinkBoxes boxes = link_boxes(with_sticks(kBare), {"ground", "cart", "rod", "bob", "tool"});
  EXPECT_TRUE(boxes[0].empty()) << "one joint needs no stick of the root";
  ASSERT_EQ(boxes[1].size(), 1U);
  EXPECT_DOUBLE_EQ(boxes[1][0].half.x(), 0.05)
      << "a box where the link slides; half of five times 2 % of the longest link, which is 1 m";
  // The rod: a stick along x to the knee, a sphere at its joint; no stick to its centre of mass.
  ASSERT_EQ(boxes[2].size(), 2U);
  EXPECT_TRUE(boxes[2][0].pose.translation().isApprox(Eigen::Vector3d(0.5, 0.0, 0.0), 1e-12));
  EXPECT_DOUBLE_EQ(boxes[2][0].half.z(), 0.5);
  EXPECT_DOUBLE_EQ(boxes[2][0].half.x(), 0.02);
  EXPECT_TRUE((boxes[2][0].pose.linear() * Eigen::Vector3d::UnitZ())
                  .isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(boxes[2][1].pose.translation().isZero());
  // The bob: nothing but the tool, at its origin, hangs on it. A sphere at its joint, a stick and a
  // sphere at its centre of mass.
  ASSERT_EQ(boxes[3].size(), 3U);
  EXPECT_TRUE(boxes[3][2].pose.translation().isApprox(Eigen::Vector3d(0.0, 0.0, -0.5)));
  EXPECT_TRUE(boxes[4].empty()) << "a frame without mass";
}

TEST(Sticks, RunToTheEndsOfLoopsAndBetweenTheJointsOfTheRoot) {
  std::string text = kBare;
  text.replace(
      text.find("</robot>"), 8,
      R"(<loop name="pin" type="revolute"><predecessor link="ground"><origin xyz="3 0 0"/></predecessor>
    <successor link="bob"><origin xyz="0 2 0"/></successor><axis xyz="0 1 0"/></loop></robot>)");
  ASSERT_EQ(read_urdf({"loop", text}).joints.size(), read_urdf({"bare", kBare}).joints.size() + 1)
      << "the loop is one of the model";
  const LinkBoxes boxes = link_boxes(with_sticks(text), {"ground", "bob"});
  ASSERT_EQ(boxes[0].size(), 1U);
  EXPECT_DOUBLE_EQ(boxes[0][0].half.z(), 1.5);
  ASSERT_EQ(boxes[1].size(), 2U) << "a stick to the loop in place of the one to the centre of mass";
  EXPECT_DOUBLE_EQ(boxes[1][0].half.z(), 1.0);
}

// A vendor's URDF without the package of its meshes.
TEST(Sticks, StandForMeshesThatAreNotThere) {
  const TemporaryDirectory folder;
  const std::string there = (folder.path() / "rod.stl").string();
  std::ofstream(there) << "solid";
  const auto with_mesh = [](const std::string& uri) {
    std::string text = kBare;
    const std::string rod = "<link name=\"rod\">";
    return text.replace(
        text.find(rod), rod.size(),
        rod + "<visual><geometry><mesh filename=\"" + uri + "\"/></geometry></visual>");
  };
  const auto sticks = [&](const std::string& uri) {
    return link_boxes(with_sticks(with_mesh(uri)), {"rod"})[0].size();
  };
  EXPECT_EQ(sticks("file://" + there), 0U);
  EXPECT_EQ(sticks("file://" + there + "x"), 2U);
  EXPECT_EQ(sticks("package://no_such_package_at_all/rod.stl"), 2U);
  const std::string missing = with_sticks(with_mesh("package://no_such_package_at_all/rod.stl"));
  EXPECT_EQ(with_sticks(missing), missing);
  EXPECT_EQ(missing.find("<mesh"), std::string::npos)
      << "rviz shows a robot with a mesh that it cannot load as faulty";
}

// Collisions are not drawn, but rviz loads them.
TEST(Sticks, CollisionsWithMissingMeshesAreLeftOutForViewers) {
  const auto with_collision = [](const std::string& shape) {
    std::string text = kBare;
    const std::string rod = "<link name=\"rod\">";
    return text.replace(text.find(rod), rod.size(),
                        rod + "<visual><geometry><sphere radius=\"0.1\"/></geometry></visual>" +
                            "<collision><geometry>" + shape + "</geometry></collision>");
  };
  EXPECT_EQ(
      with_sticks(with_collision("<mesh filename=\"package://no_such_package_at_all/rod.stl\"/>"))
          .find("<collision"),
      std::string::npos);
  EXPECT_NE(with_sticks(with_collision("<sphere radius=\"0.1\"/>")).find("<collision"),
            std::string::npos);
}

TEST(Sticks, ChangeNothingButTheLook) {
  const RobotDescription before = read_urdf({"bare", kBare}),
                         after = read_urdf({"drawn", with_sticks(kBare)});
  EXPECT_EQ(after.links.size(), before.links.size());
  EXPECT_EQ(after.joints.size(), before.joints.size());
}

TEST(Sticks, ATextThatNeedsNoneIsReturnedToTheLetter) {
  const std::string drawn = "<robot name='x'>  <link name='a'/>\n</robot>";
  for (const std::string& text : {drawn, std::string("no XML"), std::string(), with_sticks(kBare)})
    EXPECT_EQ(with_sticks(text), text);
}

}  // namespace
}  // namespace codesign
