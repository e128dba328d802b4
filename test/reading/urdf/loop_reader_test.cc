// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// A robot with the loop on line 3.
SourceText loop_text(const std::string& type, const std::string& content = "",
                     const std::string& ends = "<predecessor link=\"ground\"/><successor link=\"arm\"/>") {
  return pendulum("", "<loop name=\"l\" type=\"" + type + "\">" + ends + content + "</loop>");
}

JointDescription loop(const std::string& type, const std::string& content = "") { return read_urdf(loop_text(type, content)).joints.at(1); }

TEST(LoopReader, ReadsEndsWithTheirOrigins) {
  const JointDescription l =
      read_urdf(loop_text("revolute", "<axis xyz=\"0 0 1\"/>",
                          R"(<predecessor link="ground"><origin xyz="0 0 0.2" codesign:xyz="0 0 ${length}"/></predecessor>
                 <successor link="arm"><origin rpy="0 0 1"/></successor>)"))
          .joints.at(1);
  EXPECT_TRUE(l.is_loop);
  EXPECT_EQ(l.parent, 0);
  EXPECT_EQ(l.child, 1);
  EXPECT_EQ(l.origin.xyz[2].at(std::vector<double>{0.3}), 0.3);
  EXPECT_EQ(l.child_origin.rpy[2].nominal(), 1.0);
  EXPECT_EQ(l.axis[2].nominal(), 1.0);
  EXPECT_EQ(l.where.line, 3);
}

TEST(LoopReader, ReadsAllTypes) {
  EXPECT_EQ(loop("fixed").type, JointType::kFixed);
  EXPECT_EQ(loop("revolute").type, JointType::kRevolute);
  EXPECT_EQ(loop("continuous").type, JointType::kContinuous);
  EXPECT_EQ(loop("prismatic").type, JointType::kPrismatic);
  EXPECT_EQ(loop("planar").type, JointType::kPlanar);
  EXPECT_EQ(loop("codesign:spherical").type, JointType::kSpherical);
  EXPECT_EQ(loop("codesign:cylindrical").type, JointType::kCylindrical);
  EXPECT_EQ(loop("revolute").axis[0].nominal(), 1.0) << "URDF's default axis";
  expect_error(loop_text("spherical"), {"test.urdf:3: <loop name=\"l\">: unknown loop type", "codesign:spherical"});
  expect_error(loop_text("codesign:sperical"), {"did you mean \"codesign:spherical\"?"});
  expect_error(loop_text("floating"), {"unknown loop type"});
}

TEST(LoopReader, UniversalHasASecondAxis) {
  const JointDescription l = loop("codesign:universal", "<axis xyz=\"0 0 1\"/><codesign:second_axis xyz=\"1 0 0\"/>");
  EXPECT_EQ(l.axis[2].nominal(), 1.0);
  EXPECT_EQ(l.second_axis[0].nominal(), 1.0);
  EXPECT_EQ(loop("codesign:universal").second_axis[1].nominal(), 1.0);
  expect_error(loop_text("revolute", "<codesign:second_axis xyz=\"1 0 0\"/>"), {"only a loop of type codesign:universal"});
}

TEST(LoopReader, DistanceHasALength) {
  const JointDescription l = loop("codesign:distance", R"(<codesign:length value="0.4" codesign:value="${2*length}"/>)");
  EXPECT_EQ(l.type, JointType::kDistance);
  EXPECT_DOUBLE_EQ(l.distance.at(std::vector<double>{0.3}), 0.6);
  expect_error(loop_text("codesign:distance"), {"the element <codesign:length> is missing"});
  expect_error(loop_text("codesign:distance", "<codesign:length value=\"0\"/>"), {"value is not positive"});
  expect_error(loop_text("planar", "<codesign:length value=\"1\"/>"), {"only a loop of type codesign:distance"});
}

TEST(LoopReader, TakesFrictionDampingAndSprings) {
  const JointDescription l = loop("revolute",
                                  R"(<dynamics damping="1"/><codesign:torsion_spring stiffness="2"/>
      <codesign:friction mu_static="0.4" mu_dynamic="0.3" joint_length="0.1" pin_radius="0.1"/>)");
  EXPECT_EQ(l.damping.nominal(), 1.0);
  EXPECT_EQ(l.spring->stiffness.nominal(), 2.0);
  EXPECT_TRUE(l.friction);
}

TEST(LoopReader, Faults) {
  expect_error(loop_text("fixed", "", "<predecessor link=\"ground\"/>"), {"the element <successor> is missing"});
  expect_error(loop_text("fixed", "", "<predecessor link=\"arm\"/><successor link=\"arm\"/>"),
               {"predecessor and successor are the same link"});
  expect_error(loop_text("fixed", "", "<predecessor link=\"arn\"/><successor link=\"ground\"/>"), {"did you mean \"arm\"?"});
  expect_error(pendulum("", "<loop type=\"fixed\"/>"), {"the attribute name is missing"});
  expect_error(pendulum("", "<loop name=\"hinge\" type=\"fixed\"><predecessor link=\"ground\"/><successor link=\"arm\"/></loop>"),
               {"test.urdf:3: <loop>: a second loop of this name"});
}

}  // namespace
}  // namespace codesign
