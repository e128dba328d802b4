// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/overlay.h"

#include "mechanism/mass_properties.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// A vendor's file without annotations.
SourceText vendor() {
  return {"vendor.urdf", std::string("<robot name=\"vendor\">\n") + kGround + link_with("arm") +
                             "\n" +
                             joint_with("hinge", "continuous", "ground", "arm",
                                        "<origin xyz=\"0 0 0.2\" rpy=\"0 0 1\"/>") +
                             "\n</robot>"};
}

SourceText overlay(const std::string& body) {
  return {"notes.urdf", "<robot name=\"notes\" xmlns:codesign=\"urn:x\">\n" + body + "\n</robot>"};
}

const char kParameter[] = "<codesign:parameter name=\"length\" value=\"0.2\"/>";

TEST(Overlay, AddsParametersAndMergesAttributes) {
  const RobotDescription robot = read_urdf(
      vendor(),
      {overlay(std::string(kParameter) +
               "<joint name=\"hinge\"><origin codesign:xyz=\"0 0 ${length}\"/></joint>")});
  EXPECT_EQ(robot.name, "vendor");
  ASSERT_EQ(robot.parameters.size(), 1u);
  const PoseDescription& origin = robot.joints[0].origin;
  EXPECT_DOUBLE_EQ(origin.xyz[2].at(std::vector<double>{0.3}), 0.3);
  EXPECT_DOUBLE_EQ(origin.rpy[2].nominal(), 1.0) << "what the overlay does not name stays";
}

TEST(Overlay, ItsAttributesWin) {
  const RobotDescription robot = read_urdf(
      vendor(),
      {overlay("<joint name=\"hinge\"><origin xyz=\"0 0 0.5\"/><dynamics damping=\"2\"/></joint>"
               "<link name=\"arm\"><inertial><mass value=\"7\"/></inertial></link>")});
  EXPECT_DOUBLE_EQ(robot.joints[0].origin.xyz[2].nominal(), 0.5);
  EXPECT_DOUBLE_EQ(robot.joints[0].damping.nominal(), 2.0);
  EXPECT_DOUBLE_EQ(robot.links[1].inertial->mass.nominal(), 7.0);
  EXPECT_DOUBLE_EQ(robot.links[1].inertial->inertia[0].nominal(), 0.1);
}

TEST(Overlay, AnAnnotationTakesThePlaceOfItsLike) {
  const auto friction = [](const char* mu) {
    return overlay(std::string("<joint name=\"hinge\"><codesign:friction mu_static=\"") + mu +
                   "\" mu_dynamic=\"0.1\" joint_length=\"0.1\" pin_radius=\"0.1\"/></joint>");
  };
  const RobotDescription robot = read_urdf(vendor(), {friction("0.5"), friction("0.9")});
  EXPECT_DOUBLE_EQ(robot.joints[0].friction->mu_static.nominal(), 0.9);
}

TEST(Overlay, AddsLoopsAndSpringsOrMergesThemByName) {
  const char* spring =
      "<codesign:spring_damper name=\"s\" stiffness=\"5\" damping=\"1\" "
      "free_length=\"0.1\"><predecessor link=\"ground\"/>"
      "<successor link=\"arm\"/></codesign:spring_damper>";
  const char* loop =
      "<loop name=\"l\" type=\"planar\"><predecessor link=\"ground\"/><successor "
      "link=\"arm\"/></loop>";
  const SourceText first = overlay(std::string(spring) + loop);
  const SourceText second = overlay(
      "<codesign:spring_damper name=\"s\" stiffness=\"6\"/><loop name=\"l\" type=\"revolute\"/>");
  const RobotDescription robot = read_urdf(vendor(), {first, second});
  ASSERT_EQ(robot.spring_dampers.size(), 1u);
  EXPECT_DOUBLE_EQ(robot.spring_dampers[0].stiffness.nominal(), 6.0);
  EXPECT_DOUBLE_EQ(robot.spring_dampers[0].damping.nominal(), 1.0);
  ASSERT_EQ(robot.joints.size(), 2u);
  EXPECT_EQ(robot.joints[1].type, JointType::kRevolute);
}

TEST(Overlay, AddsLinksAndJoints) {
  // A floating joint between a new ground and the vendor's root.
  const RobotDescription floating = read_urdf(
      vendor(),
      {overlay("<link name=\"world\"/>" + joint_with("free", "floating", "world", "ground") +
               "<link name=\"ground\">" + kInertial + "</link>")});
  EXPECT_EQ(floating.links[static_cast<std::size_t>(floating.root)].name, "world");
  // A rotor between hinge and arm: the vendor's joint gets another child.
  const RobotDescription elastic = read_urdf(
      vendor(),
      {overlay("<joint name=\"hinge\"><child link=\"rotor\"/></joint>" + link_with("rotor") +
               joint_with("flex", "continuous", "rotor", "arm",
                          "<codesign:torsion_spring stiffness=\"50\"/>"))});
  ASSERT_EQ(elastic.joints.size(), 2U);
  EXPECT_EQ(elastic.links[static_cast<std::size_t>(elastic.joints[0].child)].name, "rotor");
  EXPECT_EQ(elastic.joints[1].spring->stiffness.nominal(), 50.0);
  expect_error(vendor(), {"notes.urdf:2: <link name=\"world\">: a second root"},
               {overlay("<link name=\"world\"/><link name=\"other\"/>" +
                        joint_with("j", "fixed", "world", "other"))});
  expect_error(vendor(), {"notes.urdf:2:", "<child>: unknown link, did you mean \"arm\"?"},
               {overlay(joint_with("j", "fixed", "ground", "armm"))});
}

TEST(Overlay, SaysNothingTwice) {
  const std::string friction =
      "<codesign:friction mu_static=\"1\" mu_dynamic=\"1\" joint_length=\"1\" pin_radius=\"1\"/>";
  const auto refused = [](const std::string& body, const std::string& fault) {
    expect_error(vendor(), {"notes.urdf:3:", fault}, {overlay(body)});
  };
  refused("<joint name=\"hinge\">" + friction + "\n" + friction + "</joint>",
          "a second <codesign:friction>");
  refused("<joint name=\"hinge\">" + friction + "</joint>\n<joint name=\"hinge\">" + friction +
              "</joint>",
          "a second <codesign:friction>");
  refused(std::string(kParameter) + "\n" + kParameter,
          "a second <codesign:parameter> of this name");
  refused(
      "<joint name=\"hinge\"><dynamics damping=\"1\"/></joint>\n<joint name=\"hinge\"><dynamics "
      "damping=\"2\"/></joint>",
      "sets damping a second time");
  refused(
      "<link name=\"tip\"/>" + joint_with("j", "fixed", "arm", "tip") + "\n<link name=\"tip\"/>",
      "a second <link> of this name");
  EXPECT_NO_THROW(
      read_urdf(vendor(), {overlay("<joint name=\"hinge\">" + friction +
                                   "</joint>\n<joint name=\"hinge\"><dynamics damping=\"2\"/>"
                                   "</joint>")}));
}

/// Twins of all kinds: on a joint, in an annotation, in a second visual without a name, in an
/// inertia from shapes.
SourceText arm() {
  return robot_text(
      std::string(kGround) + "\n" +
      link_with("arm",
                R"(<inertial codesign:density="1000"><mass value="0.2"/><origin xyz="0 0 0.1"/>
      <inertia ixx="0.00068333333333333332" ixy="0" ixz="0" iyy="0.00068333333333333332" iyz="0" izz="3.3333333333333335e-05"/></inertial>
      <visual><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}"/><geometry><box size="0.0316227766016838 0.0316227766016838 0.2" codesign:size="0.0316227766016838 0.0316227766016838 ${length}"/></geometry></visual>)") +
      link_with("tip", std::string(kInertial) +
                           R"(<visual><geometry><sphere radius="0.1"/></geometry></visual>
      <visual><geometry><cylinder radius="0.2" codesign:radius="${length}" length="1"/></geometry></visual>)") +
      joint_with(
          "hinge", "continuous", "ground", "arm",
          R"(<codesign:friction mu_static="0.2" codesign:mu_static="${length}" mu_dynamic="0.1" joint_length="0.1" pin_radius="0.1"/>)") +
      joint_with("wrist", "fixed", "arm", "tip",
                 R"(<origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/>)"));
}

SourceText setting(const std::string& body, const std::string& name = "set.urdf") {
  return {name, "<robot name=\"set\" xmlns:codesign=\"urn:x\">\n" + body + "\n</robot>"};
}

const char kLonger[] = R"(<codesign:set name="length" value="0.3"/>)";

TEST(SetValues, NumbersWithTwinsFollow) {
  const RobotDescription robot = read_urdf(arm(), {setting(kLonger)});
  ASSERT_EQ(robot.parameters.size(), 1U);
  EXPECT_EQ(robot.parameters[0].value, 0.3);
  EXPECT_EQ(robot.parameters[0].upper, 0.4);
  EXPECT_EQ(robot.parameters[0].where.file, "test.urdf");
  EXPECT_EQ(robot.joints[1].origin.xyz[2].nominal(), 0.3);
  EXPECT_EQ(robot.joints[0].friction->mu_static.nominal(), 0.3);
  EXPECT_DOUBLE_EQ(mass_properties(*robot.links[1].inertial, std::vector<double>{0.3}).mass, 0.3);
}

TEST(SetValues, GiveTheModelThatIsWrittenForTheseValues) {
  const std::string written = write_tuned_urdf(arm(), {}, {0.3});
  EXPECT_EQ(write_tuned_urdf(arm(), {setting(kLonger)}, {0.3}), written);
  EXPECT_EQ(written.find("codesign:set"), std::string::npos);
}

TEST(SetValues, TheLastOverlayCounts) {
  const auto value = [](const std::vector<SourceText>& overlays) {
    return read_urdf(arm(), overlays).parameters[0].value;
  };
  EXPECT_EQ(value({setting(kLonger),
                   setting(R"(<codesign:set name="length" value="0.25"/>)", "second.urdf")}),
            0.25);
  EXPECT_EQ(value({setting(kLonger),
                   setting(R"(<codesign:parameter name="length" value="0.2"/>)", "second.urdf")}),
            0.2);
  EXPECT_EQ(value({setting(kLonger),
                   setting(R"(<codesign:parameter name="length" upper="0.5"/>)", "second.urdf")}),
            0.3)
      << "bounds alone give no value";
}

TEST(SetValues, BoundsMayBeMoved) {
  const RobotDescription robot =
      read_urdf(arm(), {setting(R"(<codesign:set name="length" value="0.5" upper="0.6"/>)")});
  EXPECT_EQ(robot.parameters[0].value, 0.5);
  EXPECT_EQ(robot.parameters[0].upper, 0.6);
  EXPECT_EQ(robot.parameters[0].lower, 0.1);
}

TEST(SetValues, AModelMustAgreeWithItsOwnValuesFirst) {
  SourceText wrong = arm();
  wrong.text.replace(wrong.text.find("xyz=\"0 0 0.2\""), 13, "xyz=\"0 0 0.3\"");
  EXPECT_NE(error_of(wrong, {setting(kLonger)}).find("test.urdf"), std::string::npos);
}

TEST(SetValues, ReachTheNumbersOfAFreeInertia) {
  const SourceText free = robot_text(
      std::string(kGround) +
      link_with(
          "arm",
          R"(<inertial codesign:inertia="free"><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>)") +
      joint_with("hinge", "continuous", "ground", "arm"));
  const RobotDescription robot =
      read_urdf(free, {setting(R"(<codesign:set name="arm_alpha" value="0.5"/>)")});
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  EXPECT_DOUBLE_EQ(robot.links[1].inertial->mass.nominal(), std::exp(1.0));
  EXPECT_DOUBLE_EQ(mass_properties(*robot.links[1].inertial, values).mass, std::exp(1.0));
}

TEST(SetValues, AnOverlayThatIsWrittenIsRead) {
  const Parameter length{"length", 0.2, 0.1, 0.4, "m", {}};
  const std::string text = write_set_overlay(
      "a & \"b\"", "head -- line", {{length, 0.45678901234567891, "0.3 to --0.5"}}, "tail");
  EXPECT_NE(text.find("upper=\"0.4567890123456789\""), std::string::npos) << text;
  const RobotDescription robot = read_urdf(arm(), {{"written.urdf", text}});
  EXPECT_EQ(robot.parameters[0].value, 0.45678901234567891);
  EXPECT_LT(text.find("head"), text.find("0.3 to"));
  EXPECT_LT(text.find("0.3 to"), text.find("codesign:set"));
  EXPECT_LT(text.find("codesign:set"), text.find("tail"));
}

}  // namespace
}  // namespace codesign
