// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/spring_constants.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanism/constants.h"
#include "reading/urdf/urdf_reader.h"

namespace codesign {
namespace {

/// An arm whose centre of mass is at x = 0.1, with a tip that has no mass.
RobotDescription robot_with(const std::string& successor) {
  return read_urdf(
      {"test.urdf", R"(<robot name="test" xmlns:codesign="urn:test">
    <codesign:parameter name="k" value="40"/>
    <link name="ground"/><link name="tip"/>
    <link name="arm"><inertial><origin xyz="0.1 0 0"/><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <joint name="pivot" type="continuous"><parent link="ground"/><child link="arm"/></joint>
    <joint name="wrist" type="continuous"><parent link="arm"/><child link="tip"/></joint>
    <codesign:spring_damper name="s" stiffness="40" codesign:stiffness="${k}" damping="2"
        free_length="0.3">
      <predecessor link="ground"><origin xyz="0 0 1"/></predecessor>
      <successor link=")" +
                        successor +
                        R"("><origin xyz="0.3 0 0.2"/></successor></codesign:spring_damper>
    </robot>)"});
}

TEST(SpringConstants, PointsAreFromTheCentresOfMass) {
  const RobotDescription robot = robot_with("arm");
  const Topology topology = derive_topology(robot);
  const Constants<double> constants = evaluate_constants(robot, topology, std::vector<double>{7.0});
  ASSERT_EQ(constants.springs.size(), 1U);
  const SpringDamperConstants<double>& spring = constants.springs[0];
  EXPECT_EQ(spring.body_i, -1);
  EXPECT_EQ(spring.body_j, topology.link_body[2]);
  EXPECT_LT((spring.s_i - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 1e-15);
  EXPECT_LT((spring.s_j - Eigen::Vector3d(0.2, 0.0, 0.2)).norm(), 1e-15);
  EXPECT_EQ(spring.stiffness, 7.0);
  EXPECT_EQ(spring.damping, 2.0);
  EXPECT_EQ(spring.free_length, 0.3);
}

TEST(SpringConstants, ANumberThatIsNotFiniteIsAFault) {
  const RobotDescription robot = robot_with("arm");
  const Topology topology = derive_topology(robot);
  const auto fault = [&](double k) {
    return find_impossible(robot, topology,
                           evaluate_constants(robot, topology, std::vector<double>{k}));
  };
  EXPECT_EQ(fault(7.0), "");
  EXPECT_EQ(fault(HUGE_VAL), "spring-damper 's' is not finite");
}

TEST(SpringConstants, NothingPullsOnALinkWithoutMass) {
  const RobotDescription robot = robot_with("tip");
  const Topology topology = derive_topology(robot);
  try {
    evaluate_constants(robot, topology, std::vector<double>{7.0});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().value, "tip");
    EXPECT_EQ(error.fault().element, "<codesign:spring_damper name=\"s\">");
  }
}

}  // namespace
}  // namespace codesign
