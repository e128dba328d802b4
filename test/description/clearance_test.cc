// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/clearance.h"

#include <gtest/gtest.h>

#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

/// A pendulum whose pivot plays; the name of the joint has underscores as suffixes do.
RobotDescription playing() {
  return read_urdf({"play.urdf", R"(<robot name="play" xmlns:codesign="urn:mechanism_codesign">
    <link name="ground"/>
    <link name="rod"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <link name="tip"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <joint name="main_x" type="continuous"><parent link="ground"/><child link="rod"/>
      <axis xyz="0 1 0"/>
      <codesign:clearance radial="0.001" radius="0.01" stiffness="1e6"/></joint>
    <joint name="hinge" type="continuous"><parent link="rod"/><child link="tip"/>
      <axis xyz="0 1 0"/></joint></robot>)"},
                   {});
}

// Every joint that the reader lets play leads to the one contact that it has added.
TEST(Clearance, TheContactInPlaceOfAJoint) {
  const RobotDescription robot = playing();
  ASSERT_EQ(robot.contacts.size(), 1U);
  const std::string contact = robot.contacts[0].name;
  EXPECT_EQ(contact, "main_x_clearance");
  int plays = 0, with_clearance = 0;
  for (const JointDescription& joint : robot.joints) {
    if (joint.is_play) {
      ++plays;
      EXPECT_EQ(contact_of_play(joint.name), contact) << joint.name;
    }
    if (!has_clearance(robot, joint)) continue;
    ++with_clearance;
    EXPECT_EQ(clearance_contact(joint.name), contact);
    EXPECT_EQ(joint.name, "main_x");
  }
  EXPECT_EQ(plays, 2);
  EXPECT_EQ(with_clearance, 1);
}

}  // namespace
}  // namespace codesign
