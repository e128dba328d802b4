// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "math/dense.h"
#include "mechanism/mass_properties.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

std::string arm_with(const std::string& attributes, const std::string& inside) {
  return "<robot name='r' xmlns:codesign='urn:t'><codesign:parameter name='own' value='2'/><link "
         "name='ground'/><link name='arm-1'>"
         "<inertial " +
         attributes + ">" + inside +
         "</inertial></link><joint name='hinge' type='continuous'><parent link='ground'/><child "
         "link='arm-1'/><axis xyz='0 0 1'/></joint>"
         "</robot>";
}

const char* arm_numbers() {
  return "<origin xyz='0.1 0.2 -0.3' rpy='0.3 -0.2 0.5'/><mass value='2.5'/><inertia ixx='0.02' "
         "ixy='0.001' ixz='0.002' iyy='0.03' "
         "iyz='-0.003' izz='0.04'/>";
}

RobotDescription read_arm(const std::string& attributes,
                          const std::string& inside = arm_numbers()) {
  return read_urdf({"arm.urdf", arm_with(attributes, inside)});
}

std::vector<double> default_values_of(const RobotDescription& robot) {
  std::vector<double> values;
  for (const Parameter& parameter : robot.parameters) values.push_back(parameter.value);
  return values;
}

InputFault arm_refusal(const std::string& attributes, const std::string& inside = arm_numbers()) {
  try {
    read_arm(attributes, inside);
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

TEST(FreeInertia, TenParametersThatStartAtThePlainNumbers) {
  const RobotDescription free = read_arm("codesign:inertia='free'"), plain = read_arm("");
  ASSERT_EQ(free.parameters.size(), 11u);
  EXPECT_EQ(free.parameters[1].name, "arm_1_alpha");
  EXPECT_EQ(free.parameters[10].name, "arm_1_t3");
  EXPECT_EQ(free.parameters[10].unit, "m");
  EXPECT_NEAR(free.parameters[1].value, 0.5 * std::log(2.5), 1e-15);
  const MassProperties<double> a =
      mass_properties(*free.links[1].inertial, default_values_of(free));
  const MassProperties<double> b =
      mass_properties(*plain.links[1].inertial, default_values_of(plain));
  EXPECT_NEAR(a.mass, b.mass, 1e-14);
  EXPECT_LT((a.centre - b.centre).norm(), 1e-15);
  EXPECT_LT((a.inertia - b.inertia).norm(), 1e-15);
}

TEST(FreeInertia, EveryValueIsPhysicallyPossible) {
  const RobotDescription robot = read_arm("codesign:inertia='free'");
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> values = default_values_of(robot);
    for (std::size_t k = 1; k < values.size(); ++k) values[k] += normal(generator);
    const MassProperties<double> m = mass_properties(*robot.links[1].inertial, values);
    EXPECT_GT(m.mass, 0.0);
    const Eigen::VectorXd moments = symmetric_eigen(m.inertia).values;
    EXPECT_GT(moments[0], 0.0);
    EXPECT_GT(moments[0] + moments[1], moments[2] * (1.0 - 1e-12));
  }
}

TEST(FreeInertia, TheTunedFileHoldsTheNumbersAndTheirParameters) {
  const SourceText urdf{"arm.urdf", arm_with("codesign:inertia='free'", arm_numbers())};
  const RobotDescription robot = read_urdf(urdf);
  std::vector<double> values = default_values_of(robot);
  for (std::size_t k = 1; k < values.size(); ++k) values[k] += 0.03;
  const RobotDescription written = read_urdf({"tuned.urdf", write_tuned_urdf(urdf, {}, values)});
  EXPECT_EQ(default_values_of(written), values);
  const MassProperties<double> a = mass_properties(*robot.links[1].inertial, values);
  const InertialDescription& inertial = *written.links[1].inertial;
  EXPECT_NEAR(inertial.mass.nominal(), a.mass, 1e-13);
  EXPECT_NEAR(inertial.inertia[0].nominal(), a.inertia(0, 0), 1e-13);
  EXPECT_NEAR(inertial.inertia[4].nominal(), a.inertia(1, 2), 1e-13);
  EXPECT_NEAR(inertial.origin.xyz[2].nominal(), a.centre[2], 1e-13);
}

TEST(FreeInertia, AnOverlayMayFreeAVendorsLink) {
  const RobotDescription robot =
      read_urdf({"arm.urdf", arm_with("", arm_numbers())},
                {{"free.urdf",
                  "<robot name='r' xmlns:codesign='urn:t'><link name='arm-1'><inertial "
                  "codesign:inertia='free'/></link></robot>"}});
  EXPECT_EQ(robot.parameters.size(), 11u);
}

TEST(FreeInertia, ADeclaredParameterKeepsItsValueAndBounds) {
  const SourceText overlay{"found.urdf",
                           "<robot name='r' xmlns:codesign='urn:t'><codesign:parameter "
                           "name='arm_1_alpha' value='0.5' lower='0' upper='1'/>"
                           "<codesign:parameter name='arm_1_t3' value='-0.25'/></robot>"};
  const RobotDescription robot =
      read_urdf({"arm.urdf", arm_with("codesign:inertia='free'", arm_numbers())}, {overlay});
  ASSERT_EQ(robot.parameters.size(), 11u);
  EXPECT_EQ(robot.parameters[1].name, "arm_1_alpha");
  EXPECT_EQ(robot.parameters[1].upper, 1.0);
  const InertialDescription& inertial = *robot.links[1].inertial;
  EXPECT_NEAR(inertial.mass.nominal(), std::exp(1.0), 1e-14);
  EXPECT_NEAR(inertial.origin.xyz[2].nominal(), -0.25, 1e-15);
  EXPECT_NEAR(inertial.origin.xyz[1].nominal(), 0.2, 1e-15);
}

TEST(FreeInertia, RefusesWhatCannotBeFree) {
  EXPECT_EQ(arm_refusal("codesign:inertia='fre'").allowed, "free");
  EXPECT_NE(arm_refusal("codesign:inertia='free' codesign:density='100'").message.find("shapes"),
            std::string::npos);
  EXPECT_NE(
      arm_refusal(
          "codesign:inertia='free'",
          "<mass value='2.5' codesign:value='${own+0.5}'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
          "iyz='0' izz='1'/>")
          .message.find("parameters themselves"),
      std::string::npos);
  const InputFault rod =
      arm_refusal("codesign:inertia='free'",
                  "<mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='0'/>");
  EXPECT_NE(rod.message.find("extent"), std::string::npos);
  EXPECT_EQ(rod.where.line, 1);
}

}  // namespace
}  // namespace codesign
