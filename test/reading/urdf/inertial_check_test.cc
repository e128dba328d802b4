// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/inertial_check.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

SourceText with_inertial(const std::string& inertial, const std::string& visual = "") {
  return robot_text("<link name=\"a\">\n" + inertial + visual + "</link>");
}

SourceText with_numbers(const std::string& mass, const std::string& ixx, const std::string& iyy, const std::string& izz) {
  return with_inertial("<inertial><mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx + "\" ixy=\"0\" ixz=\"0\" iyy=\"" + iyy +
                       "\" iyz=\"0\" izz=\"" + izz + "\"/></inertial>");
}

const char kBox[] = R"(<visual><origin xyz="0 0 0.1" codesign:xyz="0 0 ${length/2}"/>
    <geometry><box size="0.1 0.1 0.2" codesign:size="0.1 0.1 ${length}"/></geometry></visual>)";

std::string from_shape(const std::string& density, const std::string& mass, const std::string& ixx = "0.0083333333333333332") {
  return "<inertial codesign:density=\"" + density + "\" codesign:from=\"visual\"><origin xyz=\"0 0 0.1\"/><mass value=\"" + mass +
         "\"/><inertia ixx=\"" + ixx +
         "\" ixy=\"0\" ixz=\"0\" iyy=\"0.0083333333333333332\" iyz=\"0\" izz=\"0.0033333333333333335\"/></inertial>";
}

TEST(InertialCheck, WhatIsNoNumber) {
  expect_error(with_numbers("nan", "1", "1", "1"), {"value is not finite"});
  expect_error(with_numbers("heavy", "1", "1", "1"), {"is not a number"});
}

TEST(InertialCheck, WrittenValuesMustBeThoseOfTheShapes) {
  expect_error(with_inertial(from_shape("1000", "2.1"), kBox),
               {"mass, centre or inertia differ", "<mass value=\"2.1\"/>", "allowed: <origin xyz=\"0 0 0.1\"/> <mass value=\"2"});
  expect_error(with_inertial(from_shape("1000", "2", "0.00834"), kBox), {"mass, centre or inertia differ"});
  expect_error(with_inertial("<inertial codesign:density=\"1000\"/>", kBox), {"which other readers of URDF need", "<mass value=\"2"});
}

}  // namespace
}  // namespace codesign
