// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_checks.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

TEST(VocabularyCheck, AVendorsUnknownNamesAreWarnings) {
  expect_warning(pendulum("<dynamics damping=\"1\" dampning=\"2\"/>"), "unknown_attribute",
                 {"test.urdf:2: <joint name=\"hinge\"> <dynamics>: the attribute dampning is "
                  "ignored, since no reader of URDF knows it",
                  "did you mean \"damping\"?", "to silence this: write damping", "(value: 2)"});
  expect_warning(pendulum("<limits lower=\"0\"/>"), "unknown_element",
                 {"did you mean \"limit\"?", "the element is ignored"});
  expect_warning(pendulum("<friction mu_static=\"0.1\"/>"), "unknown_element",
                 {"did you mean \"codesign:friction\"?"});
  expect_warning(pendulum("", kInertial), "unknown_element",
                 {"test.urdf:3: <inertial>: the element does not belong here", "<link>"});
}

TEST(VocabularyCheck, NamesOfOtherToolsAreLeftAlone) {
  expect_no_warning(pendulum(
      "<joint_properties friction=\"1\"/><limit effort=\"1\" velocity=\"1\" acceleration=\"3\"/>",
      "<gazebo reference=\"arm\"><mu1 vlaue=\"1\"/></gazebo><transmission "
      "name=\"t\"><type>x</type></transmission>"));
  expect_no_warning(
      robot_text("<link name=\"a\" type=\"x\"><contact><lateral_friction "
                 "value=\"1\"/></contact><turnGravityOff/></link>"));
}

TEST(VocabularyCheck, AllOfAFileAreToldInTheOrderOfItsLines) {
  const RobotDescription robot =
      read_urdf(pendulum("<dynamics damping=\"1\" K=\"2\"/>",
                         "<link name=\"tip\" colour=\"red\"/>\n" +
                             joint_with("j", "fixed", "arm", "tip", "<mimic joint=\"hinge\"/>")));
  ASSERT_EQ(robot.warnings.size(), 3U);
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(robot.warnings[static_cast<std::size_t>(k)].where.line, k + 2);
}

TEST(VocabularyCheck, TheSameNameInTheSameKindOfElementIsToldOnceWithACount) {
  const std::string inertia =
      "<inertial><origin xyz=\"0 0 0\"/><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" "
      "iyx=\"0\" iyy=\"1\" iyz=\"0\" "
      "izz=\"1\"/></inertial>\n";
  std::string links;
  for (const char* name : {"a", "b", "c"})
    links += "<link name=\"" + std::string(name) + "\">" + inertia + "</link>\n" +
             joint_with("j" + std::string(name), "fixed", "arm", name, "") + "\n";
  const RobotDescription robot = read_urdf(pendulum(
      "", links + "<link name=\"d\" iyx=\"2\"/>" + joint_with("jd", "fixed", "arm", "d", "")));
  std::vector<std::string> messages;
  for (const Warning& warning : robot.warnings)
    if (warning.code == "unknown_attribute") messages.push_back(warning.message);
  ASSERT_EQ(messages.size(), 2U) << "one of <inertia>, one of <link>";
  EXPECT_NE(messages[0].find("; the same at 2 further places of this file, the last in line"),
            std::string::npos)
      << messages[0];
  EXPECT_EQ(messages[1].find("further"), std::string::npos) << messages[1];
}

TEST(VocabularyCheck, InAnOverlayEverythingIsMeantForUs) {
  const auto refused = [](const std::string& body, const std::vector<std::string>& parts) {
    expect_error(pendulum(""), parts, {overlay_text(body)});
  };
  refused("<joint name=\"hinge\"><friction mu_static=\"0.1\"/></joint>",
          {"notes.urdf:2: <joint name=\"hinge\"> <friction>: unknown element <friction>, did you "
           "mean \"codesign:friction\"?"});
  refused("<joint name=\"hinge\"><dynamics dampning=\"0.1\"/></joint>",
          {"unknown attribute dampning, did you mean \"damping\"?"});
  refused("<joint name=\"hinge\">\n<limit efort=\"0.1\"/></joint>",
          {"notes.urdf:3:", "did you mean \"effort\"?"});
  refused("<link name=\"arm\"><inertial><mass val=\"0.1\"/></inertial></link>",
          {"unknown attribute val, did you mean \"value\"?"});
  refused("<joint name=\"hinge\"><limits effort=\"0.1\"/></joint>",
          {"unknown element <limits>, did you mean \"limit\"?"});
  refused("<joint name=\"hinge\">\n<!-- a comment -->left over</joint>",
          {"notes.urdf:3: <joint name=\"hinge\">: text between elements is not read"});
  refused("<joint name=\"hinge\" independent=\"true\"/>", {"unknown attribute independent"});
  refused("<joint name=\"hinge\"><joint_properties/></joint>",
          {"unknown element <joint_properties>"});
}

TEST(VocabularyCheck, PrefixesThatAreNearlyOurs) {
  expect_error(pendulum("<codesing:friction mu_static=\"1\"/>"),
               {"test.urdf:2:", "unknown prefix, did you mean \"codesign\"?", "codesing:friction"});
  expect_error(pendulum("<origin xyz=\"0 0 0\" Codesign:xyz=\"0 0 0\"/>"),
               {"unknown prefix", "Codesign:xyz"});
  expect_error({"a.urdf", "<robot name=\"a\" xmlns:codesing=\"urn:x\"><link name=\"l\"/></robot>"},
               {"a.urdf:1:", "xmlns:codesing"});
  expect_error(
      {"a.urdf", "<robot name=\"a\" xmlns:c=\"urn:mechanism_codesign\"><link name=\"l\"/></robot>"},
      {"must have the prefix codesign"});
  expect_error(pendulum(""), {"notes.urdf:2:", "unknown prefix"},
               {overlay_text("<joint name=\"hinge\"><cdesign:friction/></joint>")});
  expect_no_warning({"a.urdf",
                     "<robot name=\"a\" xmlns:xacro=\"urn:y\"><link name=\"l\" "
                     "drake:ignore=\"1\"/></robot>"});
}

TEST(VocabularyCheck, XacroThatWasNotRunIsRefused) {
  const auto robot = [](const std::string& prefix, const std::string& uri,
                        const std::string& body) {
    return SourceText{"a.urdf", "<robot name=\"a\" xmlns:" + prefix + "=\"" + uri +
                                    "\">\n<link name=\"l\"/>" + body + "</robot>"};
  };
  const std::string uri = "http://www.ros.org/wiki/xacro", hint = "xacro FILE.xacro > FILE.urdf";
  expect_error(robot("xacro", uri, "\n<xacro:if value=\"1\"><link name=\"m\"/></xacro:if>"),
               {"a.urdf:3: <xacro:if>: xacro has not been run", hint});
  expect_error(robot("x", "http://ros.org/wiki/xacro",
                     "<link name=\"m\"><x:cylinder_inertial mass=\"1\"/></link>"),
               {"a.urdf:2: <link name=\"m\"> <x:cylinder_inertial>: ", hint});
  expect_error(robot("y", "urn:y", "<xacro:leg/>"), {"<xacro:leg>: ", hint});
  expect_no_warning(robot("xacro", uri, ""));
}

TEST(VocabularyCheck, WhatStandsBesideTheRobot) {
  const std::string text = pendulum("").text;
  expect_warning({"a.urdf", text + "<robot name=\"b\"/>"}, "after_robot",
                 {"a.urdf:5: a second root element", "<robot>"});
  expect_warning({"a.urdf", text + "left over"}, "after_robot",
                 {"a.urdf:5: text stands after </robot>", "left over"});
  expect_no_warning({"a.urdf", text + "<!-- a comment -->"});
  SourceText overlay = overlay_text("");
  overlay.text += "<robot/>";
  expect_error(pendulum(""), {"notes.urdf:3:", "something stands after </robot>"}, {overlay});
}

TEST(VocabularyCheck, RepeatedElements) {
  expect_warning(pendulum("<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>"), "repeated_element",
                 {"a second <axis>; the first one is used"});
  EXPECT_EQ(
      read_urdf(pendulum("<axis xyz=\"0 0 1\"/><axis xyz=\"1 0 0\"/>")).joints[0].axis[2].nominal(),
      1.0);
  const std::string friction =
      "<codesign:friction mu_static=\"1\" mu_dynamic=\"1\" joint_length=\"1\" pin_radius=\"1\"/>";
  expect_error(pendulum(friction + friction), {"a second <codesign:friction>"});
  expect_error(pendulum("",
                        "<loop name=\"l\" type=\"revolute\"><predecessor "
                        "link=\"arm\"/><predecessor link=\"arm\"/>"
                        "<successor link=\"ground\"/></loop>"),
               {"a second <predecessor>"});
}

}  // namespace
}  // namespace codesign
