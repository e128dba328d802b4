// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include "mechanism/mass_properties.h"
#include "reading/urdf/inertial_text.h"

namespace codesign {
namespace {

TEST(InertialReader, ReadsNumbersAndTwins) {
  const RobotDescription robot = read_urdf(with_inertial(
      R"(<inertial><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}" rpy="0 0 1"/><mass value="2" codesign:value="${10*length}"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1" codesign:ixx="${length/2}"/></inertial>)"));
  const InertialDescription& inertial = *robot.links[0].inertial;
  const std::vector<double> at = {0.3};
  EXPECT_DOUBLE_EQ(inertial.mass.at(at), 3.0);
  EXPECT_DOUBLE_EQ(inertial.inertia[0].at(at), 0.15);
  EXPECT_DOUBLE_EQ(inertial.origin.xyz[2].at(at), 0.15);
  EXPECT_DOUBLE_EQ(inertial.origin.rpy[2].at(at), 1.0);
  EXPECT_FALSE(inertial.density);
}

TEST(InertialReader, NoMassIsNoInertial) {
  EXPECT_FALSE(read_urdf(with_inertial("")).links[0].inertial);
  EXPECT_FALSE(read_urdf(with_numbers("0", "0", "0", "0")).links[0].inertial);
}

TEST(InertialReader, FromShapesFollowsTheParameters) {
  const RobotDescription robot = read_urdf(with_inertial(from_shape("1000", "2"), kBox));
  const MassProperties<double> properties =
      mass_properties(*robot.links[0].inertial, std::vector<double>{0.4});
  EXPECT_DOUBLE_EQ(properties.mass, 4.0);
  EXPECT_DOUBLE_EQ(properties.centre[2], 0.2);
  EXPECT_DOUBLE_EQ(properties.inertia(0, 0), 4.0 * (0.01 + 0.16) / 12.0);
}

TEST(InertialReader, ADensityMayDependOnParameters) {
  const RobotDescription robot = read_urdf(with_inertial(from_shape("${200/length}", "2"), kBox));
  EXPECT_DOUBLE_EQ(mass_properties(*robot.links[0].inertial, std::vector<double>{0.4}).mass, 2.0);
}

}  // namespace
}  // namespace codesign
