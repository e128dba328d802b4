// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/joint_reader.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// Two arms on the ground, which a constraint connects to a closed linkage.
SourceText arms(const std::string& constraint) {
  return robot_text(kGround + link_with("a") + link_with("b") +
                    joint_with("ja", "continuous", "ground", "a", "<axis xyz=\"0 0 1\"/>") +
                    joint_with("jb", "continuous", "ground", "b", "<axis xyz=\"0 0 1\"/>") + "\n" +
                    constraint);
}

std::string between(const std::string& attributes, const std::string& on_a, const std::string& on_b,
                    const std::string& more = "") {
  return "<constraint " + attributes + "><predecessor link=\"a\">" + on_a +
         "</predecessor><successor link=\"b\">" + on_b + "</successor>" + more + "</constraint>";
}

TEST(ConstraintReader, APositionIsASphericalLoop) {
  const RobotDescription robot =
      read_urdf(arms(between("name=\"close\" type=\"position\"", "<origin xyz=\"0.3 0 0\"/>",
                             "<origin xyz=\"0.1 0.2 0\"/>")));
  EXPECT_TRUE(robot.warnings.empty());
  ASSERT_EQ(robot.joints.size(), 3U);
  const JointDescription& loop = robot.joints[2];
  EXPECT_TRUE(loop.is_loop);
  EXPECT_EQ(loop.type, JointType::kSpherical);
  EXPECT_EQ(loop.name, "close");
  EXPECT_EQ(loop.origin.xyz[0].nominal(), 0.3);
  EXPECT_EQ(loop.child_origin.xyz[1].nominal(), 0.2);
}

TEST(ConstraintReader, ASphericalJointIsTheSame) {
  const RobotDescription robot = read_urdf(
      arms(between("name=\"close\" type=\"spherical_joint\"", "<origin xyz=\"0.3 0 0\"/>", "")));
  EXPECT_TRUE(robot.warnings.empty());
  ASSERT_EQ(robot.joints.size(), 3U);
  EXPECT_EQ(robot.joints[2].type, JointType::kSpherical);
}

TEST(ConstraintReader, ACouplingMayRoll) {
  const auto coupling = [](const std::string& attributes, const std::string& a,
                           const std::string& b, const std::string& more) {
    return arms("<coupling name=\"gear\"" + attributes + "><predecessor link=\"a\">" + a +
                "</predecessor><successor link=\"b\">" + b + "</successor>" + more + "</coupling>");
  };
  const std::string on_a = "<origin xyz=\"0.3 0 0\"/>", on_b = "<origin xyz=\"-0.1 0 0\"/>",
                    rolling = " type=\"rolling\"";
  EXPECT_DOUBLE_EQ(read_urdf(coupling(rolling, on_a, on_b, "")).couplings.at(0).ratio.nominal(),
                   3.0);
  EXPECT_EQ(
      read_urdf(coupling(rolling, "", "", "<ratio value=\"6\"/>")).couplings.at(0).ratio.nominal(),
      6.0);
  EXPECT_THROW(read_urdf(coupling(" type=\"slipping\"", "", "", "<ratio value=\"6\"/>")),
               InputError);
  EXPECT_THROW(read_urdf(coupling("", on_a, "", "<ratio value=\"6\"/>")), InputError);
  EXPECT_THROW(read_urdf(coupling("", "", "", "")), InputError);
}

TEST(ConstraintReader, ANameOfItsOwnWhereItHasNone) {
  const RobotDescription robot = read_urdf(arms(between("type=\"position\"", "", "") +
                                                between("name=\"ja\" type=\"position\"", "", "")));
  EXPECT_EQ(robot.joints.at(2).name, "constraint");
  EXPECT_EQ(robot.joints.at(3).name, "ja_1");
}

TEST(ConstraintReader, RollingIsACoupling) {
  const auto ratio = [](const std::string& constraint) {
    return read_urdf(arms(constraint)).couplings.at(0).ratio.nominal();
  };
  EXPECT_EQ(ratio(between("name=\"gear\" type=\"rolling\"", "", "", "<ratio value=\"6\"/>")), 6.0);
  EXPECT_DOUBLE_EQ(ratio(between("name=\"gear\" type=\"rolling\"", "<origin xyz=\"0.3 0 0.7\"/>",
                                 "<origin xyz=\"-0.1 0 0\"/>")),
                   3.0);
  EXPECT_EQ(ratio(between("name=\"gear\" type=\"rolling\"", "", "")), 1.0);
}

}  // namespace
}  // namespace codesign
