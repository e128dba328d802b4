// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "reading/urdf/joint_reader.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

const char kBetween[] = "<predecessor link=\"ground\"/><successor link=\"arm\"/>";

SourceText spring_text(const std::string& attributes, const std::string& content) {
  return hinged_arm(
      "", "<codesign:spring_damper " + attributes + ">" + content + "</codesign:spring_damper>");
}

TEST(SpringReader, NumbersAndEnds) {
  const RobotDescription robot = read_urdf(spring_text(
      R"(name="s" stiffness="1000" damping="50" free_length="0.2" codesign:free_length="${length}")",
      R"(<predecessor link="ground"><origin xyz="0 0 1"/></predecessor><successor link="arm"/>)"));
  const SpringDamperDescription& spring = robot.spring_dampers.at(0);
  EXPECT_EQ(spring.name, "s");
  EXPECT_EQ(spring.stiffness.nominal(), 1000.0);
  EXPECT_EQ(spring.damping.nominal(), 50.0);
  EXPECT_EQ(spring.free_length.at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(spring.predecessor_origin.xyz[2].nominal(), 1.0);
  expect_error(
      spring_text("name=\"s\"", kBetween),
      {"test.urdf:3: <codesign:spring_damper name=\"s\">: the attribute stiffness is missing"});
  expect_error(spring_text("name=\"s\" stiffness=\"-1\"", kBetween), {"stiffness is negative"});
  expect_error(spring_text("stiffness=\"1\"", kBetween), {"the attribute name is missing"});
  expect_error(spring_text("name=\"s\" stiffness=\"1\"", "<predecessor link=\"ground\"/>"),
               {"the element <successor> is missing"});
}

}  // namespace
}  // namespace codesign
