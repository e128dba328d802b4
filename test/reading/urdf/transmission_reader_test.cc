// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/transmission_reader.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

RobotDescription read(const std::string& transmissions, const std::string& actuator = "<codesign:actuator rotor_inertia=\"1e-5\"/>") {
  return read_urdf(pendulum(actuator, transmissions));
}

std::string simple(const std::string& on_actuator, const std::string& on_joint = "", const std::string& below = "") {
  const auto reduction = [](const std::string& x) { return x.empty() ? "" : "<mechanicalReduction>" + x + "</mechanicalReduction>"; };
  return "<transmission name=\"t\"><type>transmission_interface/SimpleTransmission</type><joint name=\"hinge\">" + reduction(on_joint) +
         "</joint><actuator name=\"motor\">" + reduction(on_actuator) + "</actuator>" + reduction(below) + "</transmission>";
}

double ratio_of(const RobotDescription& robot) { return robot.joints[0].actuator->gear_ratio.nominal(); }

TEST(TransmissionReader, TheReductionIsTheGearRatio) {
  EXPECT_EQ(ratio_of(read("")), 1.0);
  EXPECT_EQ(ratio_of(read(simple("50"))), 50.0);
  EXPECT_EQ(ratio_of(read(simple("", " -7.5 "))), -7.5);
  EXPECT_EQ(ratio_of(read(simple("", "", "63.16"))), 63.16);
  EXPECT_EQ(ratio_of(read("<transmission type=\"pr2_mechanism_model/SimpleTransmission\" name=\"t\"><actuator name=\"m\"/><joint "
                          "name=\"hinge\"/><mechanicalReduction>20</mechanicalReduction></transmission>")),
            20.0);
  for (const char* none : {"50", ""}) EXPECT_TRUE(read(simple(none)).warnings.empty());
}

TEST(TransmissionReader, TheAnnotationComesFirst) {
  EXPECT_EQ(ratio_of(read(simple("50"), "<codesign:actuator rotor_inertia=\"1e-5\" gear_ratio=\"3\"/>")), 3.0);
}

TEST(TransmissionReader, WithoutAnActuatorNothingIsReadOrSaid) {
  const RobotDescription robot = read(simple("x") + simple("50"), "");
  EXPECT_FALSE(robot.joints[0].actuator.has_value());
  EXPECT_TRUE(robot.warnings.empty());
}

void expect_warning(const RobotDescription& robot, const std::string& code, const std::string& value) {
  ASSERT_EQ(robot.warnings.size(), 1U);
  EXPECT_EQ(robot.warnings[0].code, code);
  EXPECT_NE(robot.warnings[0].message.find("value: " + value), std::string::npos) << robot.warnings[0].message;
  EXPECT_NE(robot.warnings[0].message.find("gear_ratio"), std::string::npos) << robot.warnings[0].message;
  EXPECT_EQ(robot.warnings[0].where.line, 3);
}

TEST(TransmissionReader, WarnsOfWhatItLeavesOut) {
  const RobotDescription unread = read(simple("fifty"));
  EXPECT_EQ(ratio_of(unread), 1.0);
  expect_warning(unread, "transmission_not_read", "fifty");
  const RobotDescription twice = read(simple("50", "2"));
  EXPECT_EQ(ratio_of(twice), 50.0);
  expect_warning(twice, "transmission_contradicts", "2");
  EXPECT_TRUE(read(simple("50", "50")).warnings.empty());
  const RobotDescription other = read(
      "<transmission name=\"t\"><type>transmission_interface/DifferentialTransmission</type><joint name=\"hinge\"/><joint name=\"b\"/>"
      "<actuator name=\"m\"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>");
  EXPECT_EQ(ratio_of(other), 1.0);
  expect_warning(other, "transmission_not_simple", "transmission_interface/DifferentialTransmission");
}

}  // namespace
}  // namespace codesign
