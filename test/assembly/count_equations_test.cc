// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "assembly/count_equations.h"
#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "mechanism_codesign/counts.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

Eigen::MatrixXd diagonal(const Eigen::VectorXd& values) { return values.asDiagonal(); }

TEST(DimensionOfCone, OfOneEquation) {
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector2d(0.0, 0.0))}), 2) << "no equation";
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector2d(1.0, 0.0))}), 1) << "a double line";
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector2d(1.0, -2.0))}), 1) << "two lines";
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector2d(1.0, 3.0))}), 0) << "the origin alone";
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, 1.0, -1.0))}), 2);
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, 1.0, 0.0))}), 1);
}

TEST(DimensionOfCone, OfSeveral) {
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, -1.0, 0.0)),
                               diagonal(Eigen::Vector3d(0.0, 1.0, -1.0))}),
            1);
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, 0.0, 0.0)),
                               diagonal(Eigen::Vector3d(0.0, 1.0, 0.0))}),
            1);
  EXPECT_EQ(
      dimension_of_cone({diagonal(Eigen::Vector2d(1.0, 0.0)), diagonal(Eigen::Vector2d(0.0, 1.0))}),
      0);
  EXPECT_EQ(dimension_of_cone({}), 0);
}

/// A planar four-bar along the x axis: bar "two" (length b) hangs on bar "one" (length a), bar
/// "three" (length c) on a hinge at x = d, and the ends of "two" and "three" are tied together.
int lost(double a, double b, double c, double d, const std::string& start = "{}") {
  const auto number = [](double x) { return std::to_string(x); };
  const auto bar = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
           "izz='1'/></inertial></link>";
  };
  const auto joint = [&number](const std::string& name, const std::string& parent,
                               const std::string& child, double x) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + number(x) +
           " 0 0'/><axis xyz='0 0 1'/></joint>";
  };
  const std::string urdf =
      "<robot name='bars'><link name='ground'/>" + bar("one") + bar("two") + bar("three") +
      joint("j1", "ground", "one", 0.0) + joint("j2", "one", "two", a) +
      joint("j3", "ground", "three", d) +
      "<constraint name='tie' type='position'><predecessor link='three'><origin xyz='" + number(c) +
      " 0 0'/></predecessor><successor link='two'><origin xyz='" + number(b) +
      " 0 0'/></successor></constraint></robot>";
  Compiled mechanism(urdf,
                     "{duration: 1.0, initial_state: " + start +
                         ", objective: {integral: [{signal: j1/velocity}]}}",
                     1e-9);
  EXPECT_TRUE(mechanism.start().ok());
  return motions_lost_to_curvature(mechanism.system.parameters(), mechanism.assembly,
                                   mechanism.equations);
}

TEST(Mobility, AFlatParallelogramMovesOnOneOfTwoBranches) {
  EXPECT_EQ(lost(0.3, 0.5, 0.3, 0.5), 1);
}

TEST(Mobility, BarsThatAreAlwaysStretchedTurnAsOne) { EXPECT_EQ(lost(0.1, 0.2, 0.3, 0.0), 1); }

TEST(Mobility, ARegularPositionLosesNothing) {
  EXPECT_EQ(lost(0.3, 0.5, 0.3, 0.5, "{j1: {position: 0.7}, j2: {guess: -0.7}, j3: {guess: 0.7}}"),
            0);
}

Counts counts_of(const std::string& urdf, const std::string& study) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  const auto system = make_system(robot, read_study({"test.yaml", study}, robot));
  Status status;
  const Counts counts = count_equations(*system, system->parameters(), &status);
  EXPECT_TRUE(status.ok()) << status.cause;
  return counts;
}

TEST(Counts, OfADoublePendulumWithAnIntegralAndTwoParameters) {
  const Counts c = counts_of(
      double_pendulum(),
      let_go(
          "{}", "elbow/velocity",
          "parameters: {k: {initial: 1.0}, l: {initial: 2.0}}\n"
          "controllers: {servo: {type: pid, input: elbow/position, setpoint: 0.0, output: elbow, "
          "gains: {p: \"${k}\", i: \"${l}\"}}}\n"));
  EXPECT_EQ(c.bodies, 2);
  EXPECT_EQ(c.coordinates, 14);
  EXPECT_EQ(c.first_order_equations, 28);
  EXPECT_EQ(c.controller_states, 1);
  EXPECT_EQ(c.degrees_of_freedom, 2);
  EXPECT_EQ(c.constraints, 12);
  EXPECT_EQ(c.redundant_constraints, 0);
  EXPECT_EQ(c.dynamic_equations, 40);
  EXPECT_EQ(c.parameters, 2);
  EXPECT_EQ(c.sensitivities, 80);
  EXPECT_EQ(c.total_equations, 120);
}

TEST(Counts, RedundantRowsAreNamedAndDoNotTakeFreedom) {
  const Counts c =
      counts_of(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"));
  EXPECT_EQ(c.degrees_of_freedom, 1);
  EXPECT_EQ(c.redundant_constraints, 3);
  ASSERT_EQ(c.redundant_rows.size(), 3U);
  for (const ConstraintRow& row : c.redundant_rows) {
    EXPECT_EQ(row.joint, "right_pin") << "the loop is what could be left out";
    EXPECT_FALSE(row.kind.empty());
  }
}

}  // namespace

}  // namespace codesign
