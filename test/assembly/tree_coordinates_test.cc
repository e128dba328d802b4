// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/tree_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "equations/compiled.h"
#include "mechanism/constants.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// A hinge, a slide, a planar and a floating joint one after the other, each with a mass behind it.
std::string every_joint() {
  const auto mass = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><origin xyz='0.1 0.2 -0.3'/><mass value='2'/><inertia ixx='0.1' ixy='0' "
           "ixz='0' iyy='0.1' iyz='0' izz='0.1'/>"
           "</inertial></link>";
  };
  return robot_text(kGround + mass("a") + mass("b") + mass("c") + mass("d") +
                    joint_with("hinge", "continuous", "ground", "a",
                               "<origin xyz='1 0 0' rpy='0.2 0.1 0'/><axis xyz='0 0 1'/>") +
                    joint_with("slide", "prismatic", "a", "b",
                               "<axis xyz='0 2 0'/><limit effort='1' velocity='1'/>") +
                    joint_with("planar", "planar", "b", "c",
                               "<origin xyz='0 0.1 0' rpy='0 0.3 0'/><axis xyz='1 0 1'/>") +
                    joint_with("floating", "floating", "c", "d", "<origin xyz='0.1 0 0'/>"))
      .text;
}

const char* const kStart =
    "{hinge: {position: 0.1}, floating: {translation: [0.0, 0.0, 0.0], rotation: [0.4, -0.2, 0.9], "
    "linear_velocity: [0.0, 0.0, 0.0], "
    "angular_velocity: [0.0, 0.0, 0.0]}}";

Eigen::VectorXd numbers(double phase) {
  Eigen::VectorXd x(11);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = 0.7 * std::sin(2.0 * static_cast<double>(k) + phase);
  return x;
}

TEST(TreeCoordinates, AreTheInverseOfForwardKinematicsForEveryKindOfJoint) {
  Compiled c(every_joint(), let_go(kStart, "hinge/position"));
  ASSERT_TRUE(c.start().ok());
  const std::vector<double> parameters = c.system.parameters();
  const TreeLayout tree(c.system.robot());
  for (double phase : {0.0, 1.0, 2.5}) {
    const Eigen::VectorXd theta = numbers(phase), rate = numbers(phase + 0.3);
    State<double> state = c.state;
    set_turns(c.system, tree, theta, &state);
    body_coordinates(c.system, c.equations.constants(),
                     link_motions<double>(c.system.robot(), tree, parameters, theta, rate),
                     &state.q, &state.v);
    TreeCoordinates found;
    ASSERT_EQ(
        tree_coordinates(c.system, tree, state, Eigen::VectorXd::Zero(11), &c.equations, &found),
        "");
    EXPECT_LT((found.theta - theta).cwiseAbs().maxCoeff(), 1e-13) << phase;
    EXPECT_LT((found.rate - rate).cwiseAbs().maxCoeff(), 1e-13) << phase;
  }
}

TEST(TreeCoordinates, NameTheFloatingJointWhoseTurnsAreNotUnique) {
  Compiled c(every_joint(), let_go(kStart, "hinge/position"));
  ASSERT_TRUE(c.start().ok());
  const TreeLayout tree(c.system.robot());
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(11);
  theta[9] = M_PI / 2.0;
  State<double> state = c.state;
  body_coordinates(c.system, c.equations.constants(),
                   link_motions<double>(c.system.robot(), tree, c.system.parameters(), theta,
                                        Eigen::VectorXd::Zero(11)),
                   &state.q, &state.v);
  TreeCoordinates found;
  EXPECT_EQ(
      tree_coordinates(c.system, tree, state, Eigen::VectorXd::Zero(11), &c.equations, &found),
      "floating");
}

TEST(TreeCoordinates, HingesOfABallCountAndMasslessEndsStay) {
  Compiled c(ball_pendulum(), let_go("{ball_x: {position: 0.2, velocity: 1.0}, ball_y: {position: "
                                     "-0.3}, ball_z: {position: 0.5}}",
                                     "ball_x/position"));
  ASSERT_TRUE(c.start().ok());
  TreeCoordinates found;
  ASSERT_EQ(tree_coordinates(c.system, c.assembly.tree(), c.state, c.assembly.theta(), &c.equations,
                             &found),
            "");
  EXPECT_NEAR(found.theta[0], 0.2, 1e-13);
  EXPECT_NEAR(found.theta[1], -0.3, 1e-13);
  EXPECT_NEAR(found.theta[2], 0.5, 1e-13);
  EXPECT_NEAR(found.rate[0], 1.0, 1e-13);
}

TEST(TreeCoordinates, AGuessOfAJointThatPlaysIsNoPosition) {
  const std::string arm =
      robot_text(kGround + link_with("arm") +
                 joint_with("pin", "continuous", "ground", "arm",
                            "<axis xyz='0 1 0'/><codesign:clearance radial='1e-3' radius='0.01' "
                            "stiffness='1e6'/>"))
          .text;
  Compiled c(arm, let_go("{pin_x: {guess: 1.0e-4}, pin_y: {velocity: 0.1}}", "pin/position"));
  TreeLayout tree(c.system.robot());
  const GivenStart given(c.system, &tree);
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(
        tree.offset[static_cast<std::size_t>(joint_named(c.system.robot(), name))]);
  };
  EXPECT_FALSE(given.position[at("pin_x")]);
  EXPECT_TRUE(given.guess[at("pin_x")]);
  EXPECT_TRUE(given.position[at("pin_y")]) << "zero unless the study says otherwise";
  EXPECT_FALSE(given.position[at("pin")]);
}

}  // namespace
}  // namespace codesign
