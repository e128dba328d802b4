// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_reader.h"

#include "mechanism/mass_properties.h"
#include "reading/urdf/inertial_text.h"

namespace codesign {
namespace {

TEST(ShapeReader, ShapesWithoutMass) {
  const auto with_shape = [](const std::string& shape) {
    return with_inertial(from_shape("1000", "2"),
                         "<visual><geometry>" + shape + "</geometry></visual>");
  };
  expect_error(with_inertial(from_shape("1000", "2")), {"the link has no <visual>"});
  expect_error(with_shape("<mesh filename=\"x.stl\"/>"),
               {"mass cannot be computed from this shape (value: <mesh>"});
  expect_error(with_shape("<box size=\"1 0 1\"/>"), {"the box has no volume"});
  expect_error(with_shape("<sphere radius=\"-1\"/>"), {"radius is not positive"});
  expect_error(with_shape(""), {"exactly one shape"});
  expect_error(with_inertial(from_shape("-1", "2"), kBox), {"the density is not positive"});
  expect_error(with_inertial("<inertial codesign:density=\"1\" codesign:from=\"colision\"/>", kBox),
               {"value: colision, allowed: visual or collision"});
  expect_error(with_inertial("<inertial codesign:from=\"visual\"/>", kBox),
               {"without codesign:density no mass can be computed"});
}

TEST(InertialCheck, WhatIsNoNumber) {
  expect_error(with_numbers("nan", "1", "1", "1"), {"value is not finite"});
  expect_error(with_numbers("heavy", "1", "1", "1"), {"is not a number"});
}

TEST(InertialCheck, WrittenValuesMustBeThoseOfTheShapes) {
  expect_error(with_inertial(from_shape("1000", "2.1"), kBox),
               {"mass, centre or inertia differ", "<mass value=\"2.1\"/>",
                "allowed: <origin xyz=\"0 0 0.1\"/> <mass value=\"2"});
  expect_error(with_inertial(from_shape("1000", "2", "0.00834"), kBox),
               {"mass, centre or inertia differ"});
  expect_error(with_inertial("<inertial codesign:density=\"1000\"/>", kBox),
               {"which other readers of URDF need", "<mass value=\"2"});
}

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

TEST(InertialReader, MissingParts) {
  expect_error(with_inertial("<inertial><mass value=\"1\"/></inertial>"),
               {"the element <inertia> is missing"});
  expect_error(with_inertial("<inertial><mass value=\"1\"/><inertia ixx=\"1\"/></inertial>"),
               {"the attribute ixy is missing"});
  expect_warning(with_inertial(std::string(kInertial) + "\n" + kInertial), "repeated_element",
                 {"test.urdf:4:", "a second <inertial>"});
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
