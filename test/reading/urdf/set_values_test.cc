// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/set_values.h"

#include "mechanism/mass_properties.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// Twins of all kinds: on a joint, in an annotation, in a second visual without a name, in an inertia from shapes.
SourceText arm() {
  return robot_text(
      std::string(kGround) + "\n" + link_with("arm", R"(<inertial codesign:density="1000"><mass value="0.2"/><origin xyz="0 0 0.1"/>
      <inertia ixx="0.00068333333333333332" ixy="0" ixz="0" iyy="0.00068333333333333332" iyz="0" izz="3.3333333333333335e-05"/></inertial>
      <visual><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}"/><geometry><box size="0.0316227766016838 0.0316227766016838 0.2" codesign:size="0.0316227766016838 0.0316227766016838 ${length}"/></geometry></visual>)") +
      link_with("tip", std::string(kInertial) + R"(<visual><geometry><sphere radius="0.1"/></geometry></visual>
      <visual><geometry><cylinder radius="0.2" codesign:radius="${length}" length="1"/></geometry></visual>)") +
      joint_with(
          "hinge", "continuous", "ground", "arm",
          R"(<codesign:friction mu_static="0.2" codesign:mu_static="${length}" mu_dynamic="0.1" joint_length="0.1" pin_radius="0.1"/>)") +
      joint_with("wrist", "fixed", "arm", "tip", R"(<origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/>)"));
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
  const auto value = [](const std::vector<SourceText>& overlays) { return read_urdf(arm(), overlays).parameters[0].value; };
  EXPECT_EQ(value({setting(kLonger), setting(R"(<codesign:set name="length" value="0.25"/>)", "second.urdf")}), 0.25);
  EXPECT_EQ(value({setting(kLonger), setting(R"(<codesign:parameter name="length" value="0.2"/>)", "second.urdf")}), 0.2);
  EXPECT_EQ(value({setting(kLonger), setting(R"(<codesign:parameter name="length" upper="0.5"/>)", "second.urdf")}), 0.3)
      << "bounds alone give no value";
}

TEST(SetValues, BoundsMayBeMoved) {
  const RobotDescription robot = read_urdf(arm(), {setting(R"(<codesign:set name="length" value="0.5" upper="0.6"/>)")});
  EXPECT_EQ(robot.parameters[0].value, 0.5);
  EXPECT_EQ(robot.parameters[0].upper, 0.6);
  EXPECT_EQ(robot.parameters[0].lower, 0.1);
}

TEST(SetValues, AreCheckedStrictly) {
  const auto refuse = [](const std::string& body, const std::vector<std::string>& parts) { expect_error(arm(), parts, {setting(body)}); };
  refuse(R"(<codesign:set name="lenght" value="0.3"/>)", {"set.urdf:2", "unknown parameter of the model, did you mean \"length\"?"});
  refuse(R"(<codesign:set name="length" value="0.5"/>)", {"set.urdf:2", "outside the bounds", "[0.1, 0.4]"});
  refuse(R"(<codesign:set name="length" value="0.3" lower="0.4" upper="0.2"/>)",
         {"set.urdf:2", "the lower bound is above the upper bound"});
  refuse(R"(<codesign:set name="length" value="long"/>)", {"set.urdf:2", "long"});
  refuse(R"(<codesign:set name="length"/>)", {"set.urdf:2", "value"});
  refuse(R"(<codesign:set name="length" value="0.3" unit="m"/>)", {"set.urdf:2", "unknown attribute unit"});
  refuse(std::string(kLonger) + "\n" + kLonger, {"set.urdf:3", "a second <codesign:set>"});
  refuse(std::string(kLonger) + "\n" + R"(<codesign:parameter name="length" value="0.3"/>)",
         {"set.urdf:3", "declares this parameter and sets it"});
  refuse(std::string(R"(<codesign:parameter name="more" value="0.3"/>)") + "\n" + R"(<codesign:set name="more" value="1"/>)",
         {"set.urdf:3", "declares this parameter and sets it"});
}

TEST(SetValues, AModelHasNone) {
  expect_error(pendulum("", kLonger), {"test.urdf:3", "only an overlay sets values of parameters", "<codesign:parameter>"});
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
  const RobotDescription robot = read_urdf(free, {setting(R"(<codesign:set name="arm_alpha" value="0.5"/>)")});
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  EXPECT_DOUBLE_EQ(robot.links[1].inertial->mass.nominal(), std::exp(1.0));
  EXPECT_DOUBLE_EQ(mass_properties(*robot.links[1].inertial, values).mass, std::exp(1.0));
}

TEST(SetValues, AnOverlayThatIsWrittenIsRead) {
  const Parameter length{"length", 0.2, 0.1, 0.4, "m", {}};
  const std::string text = write_set_overlay("a & \"b\"", "head -- line", {{length, 0.45678901234567891, "0.3 to --0.5"}}, "tail");
  EXPECT_NE(text.find("upper=\"0.4567890123456789\""), std::string::npos) << text;
  const RobotDescription robot = read_urdf(arm(), {{"written.urdf", text}});
  EXPECT_EQ(robot.parameters[0].value, 0.45678901234567891);
  EXPECT_LT(text.find("head"), text.find("0.3 to"));
  EXPECT_LT(text.find("0.3 to"), text.find("codesign:set"));
  EXPECT_LT(text.find("codesign:set"), text.find("tail"));
}

}  // namespace
}  // namespace codesign
