// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/annotated_urdf.h"

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

const char kEnds[] = "<predecessor link=\"ground\"/><successor link=\"arm\"/>";

SourceText coupling_text(const std::string& content) { return pendulum("", "<coupling name=\"c\">" + content + "</coupling>"); }
SourceText spring_text(const std::string& attributes, const std::string& content) {
  return pendulum("", "<codesign:spring_damper " + attributes + ">" + content + "</codesign:spring_damper>");
}

TEST(AnnotatedUrdf, Couplings) {
  const RobotDescription robot = read_urdf(coupling_text(std::string(kEnds) + R"(<ratio value="0.4" codesign:value="${2*length}"/>)"));
  ASSERT_EQ(robot.couplings.size(), 1u);
  EXPECT_EQ(robot.couplings[0].predecessor, 0);
  EXPECT_EQ(robot.couplings[0].successor, 1);
  EXPECT_DOUBLE_EQ(robot.couplings[0].ratio.at(std::vector<double>{0.3}), 0.6);
  expect_error(coupling_text(kEnds), {"test.urdf:3: <coupling name=\"c\">: the element <ratio> is missing"});
  expect_error(coupling_text(std::string(kEnds) + "<ratio value=\"0\"/>"), {"the ratio is zero"});
  expect_error(coupling_text("<predecessor link=\"arm\"/><successor link=\"arm\"/><ratio value=\"1\"/>"), {"the same link"});
}

TEST(AnnotatedUrdf, SpringDampers) {
  const RobotDescription robot =
      read_urdf(spring_text(R"(name="s" stiffness="1000" damping="50" free_length="0.2" codesign:free_length="${length}")",
                            R"(<predecessor link="ground"><origin xyz="0 0 1"/></predecessor><successor link="arm"/>)"));
  const SpringDamperDescription& spring = robot.spring_dampers.at(0);
  EXPECT_EQ(spring.name, "s");
  EXPECT_EQ(spring.stiffness.nominal(), 1000.0);
  EXPECT_EQ(spring.damping.nominal(), 50.0);
  EXPECT_EQ(spring.free_length.at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(spring.predecessor_origin.xyz[2].nominal(), 1.0);
  expect_error(spring_text("name=\"s\"", kEnds), {"test.urdf:3: <codesign:spring_damper name=\"s\">: the attribute stiffness is missing"});
  expect_error(spring_text("name=\"s\" stiffness=\"-1\"", kEnds), {"stiffness is negative"});
  expect_error(spring_text("stiffness=\"1\"", kEnds), {"the attribute name is missing"});
  expect_error(spring_text("name=\"s\" stiffness=\"1\"", "<predecessor link=\"ground\"/>"), {"the element <successor> is missing"});
}

TEST(AnnotatedUrdf, ARobotHasAName) {
  expect_error({"a.urdf", "<robot><link name=\"a\"/></robot>"}, {"a.urdf:1: <robot>: the attribute name is missing"});
}

}  // namespace
}  // namespace codesign
