// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <cmath>

#include "description/study.h"
#include "equations/compiled.h"
#include "math/differences.h"
#include "mechanism/constants.h"
#include "reading/urdf/urdf_fixture.h"
#include "system/tree_kinematics.h"

namespace codesign {
namespace {

/// Every kind of tree joint one after the other, written in the wrong order.
const RobotDescription& robot() {
  static const RobotDescription robot = read_urdf(robot_text(
      kGround + link_with("e") + link_with("d") + link_with("c") + link_with("b") + link_with("a") +
      joint_with("floating", "floating", "d", "e", "<origin xyz='0.1 0 0'/>") +
      joint_with("planar", "planar", "c", "d", "<origin xyz='0 0.1 0'/><axis xyz='0 0 1'/>") +
      joint_with("fixed", "fixed", "b", "c",
                 "<origin xyz='0 0 0.2' codesign:xyz='0 0 ${length}' rpy='0.3 0 0'/>") +
      joint_with("slide", "prismatic", "a", "b",
                 "<axis xyz='0 2 0'/><limit effort='1' velocity='1'/>") +
      joint_with("hinge", "continuous", "ground", "a",
                 "<origin xyz='1 0 0'/><axis xyz='0 0 1'/>")));
  return robot;
}

std::vector<LinkMotion<double>> motions(const Eigen::VectorXd& theta, const Eigen::VectorXd& rate) {
  return link_motions<double>(robot(), TreeLayout(robot()), {0.2}, theta, rate);
}

Eigen::VectorXd generic(double phase) {
  Eigen::VectorXd x(11);
  for (Eigen::Index k = 0; k < x.size(); ++k)
    x[k] = 0.7 * std::sin(2.0 * static_cast<double>(k) + phase);
  return x;
}

TEST(TreeLayout, ParentsComeFirstAndEachJointHasItsCoordinates) {
  const TreeLayout layout(robot());
  EXPECT_EQ(layout.size, 1 + 1 + 3 + 6);
  EXPECT_EQ(layout.joint_order, (std::vector<int>{4, 3, 2, 1, 0}));
  EXPECT_EQ(layout.offset[4], 0);
  EXPECT_EQ(layout.offset[3], 1);
  EXPECT_EQ(layout.offset[1], 2);
  EXPECT_EQ(layout.offset[0], 5);
}

TEST(LinkMotions, AHingeAndASlideByHand) {
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(11), rate = theta;
  theta[0] = 1.5707963267948966;
  theta[1] = 0.5;
  rate[0] = 2.0;
  rate[1] = 3.0;
  const auto links = motions(theta, rate);
  // Link b has slid by 0.5 along a's y, which the hinge has turned to the ground's -x; the turn
  // carries it towards -y.
  const LinkMotion<double>& b = links[4];
  EXPECT_LT((b.X.t - Eigen::Vector3d(0.5, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((b.omega - Eigen::Vector3d(0.0, 0.0, 2.0)).norm(), 1e-15);
  EXPECT_LT((b.velocity - Eigen::Vector3d(-3.0, -1.0, 0.0)).norm(), 1e-15);
}

TEST(LinkMotions, VelocitiesAreTheDerivativesOfThePoses) {
  const Eigen::VectorXd theta = generic(0.3), rate = generic(1.1);
  const auto real = motions(theta, rate);
  for (std::size_t k = 0; k < real.size(); ++k) {
    // An entry of the link's pose [R t] after a time.
    const auto pose = [&](Eigen::Index row, Eigen::Index column) {
      return ridders_derivative(
                 [&, row, column](double time) {
                   const Pose<double> X = motions(theta + time * rate, rate)[k].X;
                   return column < 3 ? X.R(row, column) : X.t[row];
                 },
                 0.0, 0.1)
          .value;
    };
    Eigen::Matrix<double, 3, 4> change;
    for (Eigen::Index row = 0; row < 3; ++row)
      for (Eigen::Index column = 0; column < 4; ++column) change(row, column) = pose(row, column);
    const Eigen::Matrix3d spin = change.leftCols<3>() * real[k].X.R.transpose();
    EXPECT_LT((change.col(3) - real[k].velocity).norm(), 1e-11);
    EXPECT_LT((Eigen::Vector3d(spin(2, 1), spin(0, 2), spin(1, 0)) - real[k].omega).norm(), 1e-11);
  }
}

TEST(BodyCoordinates, AreThoseOfTheCentreOfMass) {
  Compiled bar(pendulum(), let_go("{hinge: {position: 0.4}}", "hinge/velocity"));
  bar.equations.set_design({});
  const auto links =
      link_motions<double>(bar.system.robot(), TreeLayout(bar.system.robot()), {},
                           Eigen::VectorXd::Constant(1, 0.4), Eigen::VectorXd::Constant(1, 3.0));
  Eigen::VectorXd q, v;
  body_coordinates(bar.system, bar.equations.constants(), links, &q, &v);
  EXPECT_LT((q.head<3>() - 0.5 * Eigen::Vector3d(-std::sin(0.4), 0.0, -std::cos(0.4))).norm(),
            1e-15);
  EXPECT_LT((q.tail<4>() - Eigen::Vector4d(std::cos(0.2), 0.0, std::sin(0.2), 0.0)).norm(), 1e-15);
  EXPECT_LT((v.head<3>() - 1.5 * Eigen::Vector3d(-std::cos(0.4), 0.0, std::sin(0.4))).norm(),
            1e-15);
  EXPECT_LT((v.tail<4>() - 1.5 * Eigen::Vector4d(-std::sin(0.2), 0.0, std::cos(0.2), 0.0)).norm(),
            1e-15);
}

TEST(StartRotations, AreTakenOverByFloatingJointsOfTheTreeAlone) {
  RobotDescription robot;
  for (const auto& [name, type, is_loop] : {std::tuple{"base", JointType::kFloating, false},
                                            {"hinge", JointType::kRevolute, false},
                                            {"closure", JointType::kRevolute, true}}) {
    JointDescription& joint = robot.joints.emplace_back();
    joint.name = name;
    joint.type = type;
    joint.is_loop = is_loop;
  }
  Study study;
  for (const char* name : {"base", "hinge", "closure"}) {
    InitialJointState& initial = study.initial_state.emplace_back();
    initial.joint = name;
    initial.rotation = QuantityVector{0.1, 0.2, 0.3};
  }
  EXPECT_EQ(tree_joint(robot, study.initial_state[1]), 1);
  EXPECT_EQ(tree_joint(robot, study.initial_state[2]), -1);
  const RobotDescription turned = with_start(robot, study);
  EXPECT_EQ(turned.joints[0].start_rotation[2].nominal(), 0.3);
  EXPECT_EQ(turned.joints[1].start_rotation[2].nominal(), 0.0);
}

}  // namespace

}  // namespace codesign
