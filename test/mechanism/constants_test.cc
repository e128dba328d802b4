// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "math/differences.h"
#include "mechanism/constants.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

struct Mechanism {
  RobotDescription robot;
  Topology topology;

  explicit Mechanism(const std::string& content)
      : robot(read_urdf(robot_text(kGround + content))), topology(derive_topology(robot)) {}
  Constants<double> at(double length) const {
    return evaluate_constants<double>(robot, topology, {length});
  }
};

std::string ball(const std::string& name, const std::string& mass, const std::string& twin = "") {
  return link_with(
      name, "<inertial><mass value='" + mass + "' " + twin +
                "/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>");
}

/// Two balls of 1 and 3 kg, fixed to each other at the distance `length` along x.
Mechanism dumbbell() {
  return Mechanism(ball("near", "1") + ball("far", "3") +
                   joint_with("hinge", "continuous", "ground", "near",
                              "<origin xyz='0 0 1'/><axis xyz='0 0 1'/>") +
                   joint_with("bar", "fixed", "near", "far",
                              "<origin xyz='0.2 0 0' codesign:xyz='${length} 0 0'/>"));
}

TEST(Constants, FixedLinksAreOneBodyAboutItsCentreOfMass) {
  const Constants<double> c = dumbbell().at(0.4);
  ASSERT_EQ(c.bodies.size(), 1U);
  EXPECT_DOUBLE_EQ(c.bodies[0].mass, 4.0);
  EXPECT_LT((c.bodies[0].centre - Eigen::Vector3d(0.3, 0.0, 0.0)).norm(), 1e-15);
  // Steiner: 1 kg at 0.3 m and 3 kg at 0.1 m across the bar.
  const Eigen::Vector3d moments(0.2, 0.2 + 0.09 + 0.03, 0.2 + 0.09 + 0.03);
  EXPECT_LT((c.bodies[0].J - Eigen::Matrix3d(moments.asDiagonal())).norm(), 1e-15);
}

TEST(Constants, LinksAndJointPointsAreSeenFromTheCentreOfMass) {
  const Constants<double> c = dumbbell().at(0.4);
  EXPECT_LT(c.links[0].s.norm(), 1e-15) << "the ground's origin is its own";
  EXPECT_LT((c.links[1].s - Eigen::Vector3d(-0.3, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((c.links[2].s - Eigen::Vector3d(0.1, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((c.pairs.at(0).s_i - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 1e-15);
  EXPECT_LT((c.pairs[0].s_j - Eigen::Vector3d(-0.3, 0.0, 0.0)).norm(), 1e-15);
}

TEST(Constants, FollowTheDesign) {
  const Mechanism mechanism = dumbbell();
  // The centre is 3/4 of the length away, the moment of inertia grows as 3/4 length^2.
  const auto centre = [&](double length) { return mechanism.at(length).bodies[0].centre[0]; };
  const auto inertia = [&](double length) { return mechanism.at(length).bodies[0].J(2, 2); };
  EXPECT_NEAR(ridders_derivative(centre, 0.4, 0.1).value, 0.75, 1e-12);
  EXPECT_NEAR(ridders_derivative(inertia, 0.4, 0.1).value, 1.5 * 0.4, 1e-12);
}

std::string fault(const std::string& content, double length) {
  const Mechanism mechanism(
      content + joint_with("hinge", "continuous", "ground", "arm", "<axis xyz='0 1 0'/>"));
  return find_impossible(mechanism.robot, mechanism.topology, mechanism.at(length));
}

TEST(FindImpossible, ADesignMayBeImpossibleThoughTheDefaultIsNot) {
  const std::string light = ball("arm", "0.2", "codesign:value='${length}'");
  EXPECT_EQ(fault(light, 0.1), "");
  EXPECT_NE(fault(light, -0.1).find("body 'arm': the mass is negative"), std::string::npos);
  const auto disc = [](const std::string& ixx, const std::string& twin) {
    return link_with("arm", "<inertial><mass value='1'/><inertia ixx='" + ixx + "' codesign:ixx='" +
                                twin +
                                "' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>");
  };
  EXPECT_EQ(fault(disc("0.2", "${length}"), 0.15), "");
  EXPECT_NE(fault(disc("0.2", "${length}"), 0.21).find("triangle inequality"), std::string::npos);
  EXPECT_NE(fault(disc("0.1", "${length-0.1}"), 0.05).find("negative principal moment"),
            std::string::npos);
}

TEST(FindImpossible, NamesTheJointOfABadFriction) {
  Mechanism mechanism(
      link_with("arm") +
      joint_with("hinge", "continuous", "ground", "arm",
                 "<axis xyz='0 1 0'/><codesign:friction mu_static='0.3' mu_dynamic='0.2' "
                 "codesign:mu_dynamic='${length}' joint_length='0.1' "
                 "pin_radius='0.01'/>"));
  const auto verdict = [&](double length) {
    return find_impossible(mechanism.robot, mechanism.topology, mechanism.at(length));
  };
  EXPECT_EQ(verdict(0.25), "");
  EXPECT_NE(verdict(0.35).find("joint 'hinge'"), std::string::npos) << "mu_dynamic above mu_static";
}

// The speed of a motor behind an elastic gear is the gear ratio times that of its side.
TEST(FindImpossible, NamesAnElasticGearWithoutRatio) {
  Mechanism mechanism(
      link_with("arm") +
      joint_with("hinge", "continuous", "ground", "arm",
                 "<axis xyz='0 1 0'/><codesign:actuator gear_ratio='0.2' "
                 "codesign:gear_ratio='${length}' rotor_inertia='0.1' stiffness='100'/>"));
  const auto verdict = [&](double ratio) {
    return find_impossible(mechanism.robot, mechanism.topology, mechanism.at(ratio));
  };
  EXPECT_EQ(verdict(-0.1), "");
  EXPECT_NE(verdict(0.0).find("the elastic gear of joint 'hinge'"), std::string::npos);
}

TEST(DefaultValues, ComeInTheOrderOfTheParameters) {
  RobotDescription robot;
  EXPECT_TRUE(default_values(robot).empty());
  robot.parameters.resize(2);
  robot.parameters[0].value = 0.5;
  robot.parameters[1].value = -2.0;
  EXPECT_EQ(default_values(robot), (std::vector<double>{0.5, -2.0}));
}

std::string inertial(const std::string& mass, const std::string& ixx, const std::string& iyy,
                     const std::string& izz) {
  return "<inertial><mass value=\"" + mass + "\"/><inertia ixx=\"" + ixx +
         "\" ixy=\"0\" ixz=\"0\" iyy=\"" + iyy + "\" iyz=\"0\" izz=\"" + izz + "\"/></inertial>";
}

/// An arm with this inertial on a hinge, and a part fixed to the arm.
SourceText arm(const std::string& numbers, const std::string& part = "") {
  return robot_text(
      kGround + link_with("arm", numbers) + joint_with("hinge", "continuous", "ground", "arm") +
      "\n" +
      (part.empty() ? "" : link_with("part", part) + joint_with("weld", "fixed", "arm", "part")));
}

TEST(BodyCheck, WhatNoBodyCanHaveIsAWarning) {
  expect_warning(arm(inertial("-1", "1", "1", "1")), "negative_mass",
                 {"test.urdf:2: <link name=\"arm\"> <inertial>: the mass is negative"});
  expect_warning(arm(inertial("1", "-1", "1", "1")), "inertia_not_positive",
                 {"principal moments -1 1 1", "used as it is written"});
  expect_warning(arm(inertial("1", "1", "1", "2.1")), "triangle_inequality",
                 {"principal moments 1 1 2.1"});
  EXPECT_EQ(read_urdf(arm(inertial("1", "1", "1", "2.1"))).links[1].inertial->inertia[5].nominal(),
            2.1);
}

TEST(BodyCheck, IdealBodiesAreFine) {
  expect_no_warning(arm(inertial("1", "1", "1", "2")));           // flat
  expect_no_warning(arm(inertial("1", "1", "1", "2.000001")));    // flat, and rounded
  expect_no_warning(arm(inertial("1", "1", "1", "0")));           // a rod
  expect_no_warning(arm(inertial("1", "0", "0", "0")));           // a point
  expect_no_warning(arm(inertial("0", "1", "1", "1")));           // a rotor without mass
  expect_no_warning(arm(inertial("1", "-1e-20", "0", "1e-19")));  // rounding of a point
}

TEST(BodyCheck, LinksThatAreWeldedTogetherAreJudgedAsOne) {
  const std::string heavy = inertial("1", "1", "1", "1");
  expect_no_warning(arm(heavy, inertial("0", "0.1", "0.1", "0.1")));
  expect_no_warning(arm(heavy, inertial("0.1", "0", "0", "0.3")));
  expect_no_warning(arm(heavy, inertial("-0.1", "-0.1", "0.1", "0.1")));
  expect_warning(arm(heavy, inertial("-2", "1", "1", "1")), "negative_mass",
                 {"<link name=\"arm\">", "links: arm, part"});
  expect_error(arm(heavy, inertial("-1", "1", "1", "1")),
               {"test.urdf:2:", "fixed to each other cancel", "value: arm, part"});
}

TEST(BodyCheck, WhatNumbersCannotHoldIsRefused) {
  for (const char* mass : {"1e-300", "1e-101", "1e+101"})
    expect_error(arm(inertial(mass, "1", "1", "1")),
                 {"test.urdf:2: <link name=\"arm\"> <inertial>",
                  "the mass is out of the range that can be computed with", mass});
  expect_error(arm(inertial("1", "1e-200", "1e-200", "1e-200")),
               {"the inertia is out of the range"});
  expect_no_warning(arm(inertial("1e-99", "1e-110", "1e-110", "1e-110")));
  expect_no_warning(arm(inertial("1e-30", "1e-60", "1e-60", "1e-60")));
}

TEST(BodyCheck, TheRootIsNotJudged) {
  const auto on_base = [](const std::string& base) {
    return robot_text(link_with("base", base) + link_with("arm") +
                      joint_with("hinge", "continuous", "base", "arm"));
  };
  expect_no_warning(on_base(inertial("-1", "-1", "0", "3")));
  expect_no_warning(on_base(inertial("0", "1", "1", "1")));
}

}  // namespace

}  // namespace codesign
