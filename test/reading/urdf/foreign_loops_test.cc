// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// ground - hinge - arm - wrist (at 0.5 m) - tip, with further elements from line 4 on.
SourceText two_links(const std::string& more) {
  return pendulum(
      "", link_with("tip") +
              joint_with("wrist", "continuous", "arm", "tip", "<origin xyz=\"0.5 0 0\"/>") + "\n" +
              more);
}

void expect_loop(const std::string& element, const std::string& remedy) {
  expect_warning(two_links(element), "loop_ignored",
                 {"test.urdf:4:", "connects links or couples joints", remedy});
}

TEST(ForeignLoops, LoopJoint) {
  expect_loop(
      "<loop_joint name=\"close\" type=\"continuous\"><link1 link=\"ground\" xyz=\"1 0 0\" rpy=\"0 "
      "0 1\"/><link2 link=\"tip\" xyz=\"0 "
      "0.5 0\"/><axis xyz=\"0 1 0\"/></loop_joint>",
      "<loop name=\"close\" type=\"continuous\"><predecessor link=\"ground\"><origin xyz=\"1 0 0\" "
      "rpy=\"0 0 1\"/></predecessor>"
      "<successor link=\"tip\"><origin xyz=\"0 0.5 0\"/></successor><axis xyz=\"0 1 0\"/></loop>");
}

TEST(ForeignLoops, GazeboPointsFollowFromTheZeroPosition) {
  expect_loop(
      "<gazebo><joint name=\"close\" "
      "type=\"ball\"><parent>ground</parent><child>tip</child><pose>0.1 0 0 0 0 "
      "0</pose></joint></gazebo>",
      "<loop name=\"close\" type=\"codesign:spherical\"><predecessor link=\"ground\"><origin "
      "xyz=\"0.6 0 0\"/></predecessor>"
      "<successor link=\"tip\"><origin xyz=\"0.1 0 0\"/></successor></loop>");
  expect_no_warning(two_links(
      "<gazebo reference=\"wrist\"><implicitSpringDamper>1</implicitSpringDamper></gazebo>"));
}

TEST(ForeignLoops, GazeboMimicPluginsThatURDFDoesNotKnow) {
  const std::string plugin =
      "<gazebo><plugin filename=\"mimic.so\" "
      "name=\"m\"><joint>hinge</joint><mimicJoint>wrist</mimicJoint><multiplier>-2</multiplier></"
      "plugin>"
      "</gazebo>";
  expect_loop(
      plugin,
      "<joint name=\"wrist\"><mimic joint=\"hinge\" multiplier=\"-2\" offset=\"0\"/></joint>");
  expect_no_warning(
      pendulum("", link_with("tip") +
                       joint_with("wrist", "continuous", "arm", "tip", "<mimic joint=\"hinge\"/>") +
                       plugin));
  expect_no_warning(
      two_links("<gazebo><plugin name=\"control\"><joint>hinge</joint></plugin></gazebo>"));
}

TEST(ForeignLoops, DetachableJointsWithinTheRobot) {
  const auto plugin = [](const std::string& parent, const std::string& child) {
    return "<gazebo><plugin filename=\"gz-sim-detachable-joint-system\" "
           "name=\"gz::sim::systems::DetachableJoint\"><parent_link>" +
           parent + "</parent_link><child_model>test</child_model><child_link>" + child +
           "</child_link></plugin></gazebo>";
  };
  expect_loop(plugin("ground", "tip"),
              "type=\"fixed\"><predecessor link=\"ground\"><origin xyz=\"0.5 0 "
              "0\"/></predecessor><successor link=\"tip\"/></loop>");
  expect_no_warning(
      two_links(plugin("tip", "parcel")));  // a link of another model, which a gripper takes
}

TEST(ForeignLoops, WhatTheMessageShowsSilencesIt) {
  const std::string element =
      "<gazebo><joint name=\"close\" "
      "type=\"ball\"><parent>ground</parent><child>tip</child><pose>0.1 0 0 0 0 "
      "0</pose></joint></gazebo>";
  const std::string loop =
      "<loop name=\"close\" type=\"codesign:spherical\"><predecessor link=\"ground\"><origin "
      "xyz=\"0.6 0 0\"/></predecessor>"
      "<successor link=\"tip\"><origin xyz=\"0.1 0 0\"/></successor></loop>";
  expect_no_warning(two_links(element + loop));
  const std::string equality =
      "<equality><joint joint1=\"wrist\" joint2=\"hinge\" polycoef=\"0.1 -2 0 0 0\"/></equality>";
  expect_no_warning(
      pendulum("", link_with("tip") +
                       joint_with("wrist", "continuous", "arm", "tip",
                                  "<mimic joint=\"hinge\" multiplier=\"-2\" offset=\"0.1\"/>") +
                       equality));
}

TEST(ForeignLoops, Drake) {
  expect_loop(
      "<drake:ball_constraint><drake:ball_constraint_body_A "
      "name=\"ground\"/><drake:ball_constraint_body_B name=\"tip\"/>"
      "<drake:ball_constraint_p_AP value=\"1 0 0\"/><drake:ball_constraint_p_BQ value=\"0 2 "
      "0\"/></drake:ball_constraint>",
      "type=\"codesign:spherical\"><predecessor link=\"ground\"><origin xyz=\"1 0 "
      "0\"/></predecessor><successor link=\"tip\"><origin "
      "xyz=\"0 2 0\"/></successor></loop>");
  expect_loop(
      "<drake:joint name=\"u\" type=\"universal\"><parent link=\"arm\"/><child "
      "link=\"tip\"/></drake:joint>",
      "<loop name=\"u\" type=\"codesign:universal\"><predecessor link=\"arm\"/><successor "
      "link=\"tip\"/></loop>");
}

TEST(ForeignLoops, MujocoEqualities) {
  expect_loop(
      "<mujoco><equality><connect name=\"c\" body1=\"tip\" body2=\"ground\" anchor=\"0.2 0 "
      "0\"/></equality></mujoco>",
      "<predecessor link=\"tip\"><origin xyz=\"0.2 0 0\"/></predecessor><successor "
      "link=\"ground\"><origin xyz=\"0.7 0 0\"/>");
  expect_loop(
      "<equality><joint joint1=\"wrist\" joint2=\"hinge\" polycoef=\"0.1 -2 0 0 0\"/></equality>",
      "<joint name=\"wrist\"><mimic joint=\"hinge\" multiplier=\"-2\" offset=\"0.1\"/></joint>");
}

}  // namespace
}  // namespace codesign
