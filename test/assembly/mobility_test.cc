// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/mobility.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"

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
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, -1.0, 0.0)), diagonal(Eigen::Vector3d(0.0, 1.0, -1.0))}), 1);
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector3d(1.0, 0.0, 0.0)), diagonal(Eigen::Vector3d(0.0, 1.0, 0.0))}), 1);
  EXPECT_EQ(dimension_of_cone({diagonal(Eigen::Vector2d(1.0, 0.0)), diagonal(Eigen::Vector2d(0.0, 1.0))}), 0);
  EXPECT_EQ(dimension_of_cone({}), 0);
}

/// A planar four-bar along the x axis: bar "two" (length b) hangs on bar "one" (length a), bar "three" (length c) on a hinge at x = d, and
/// the ends of "two" and "three" are tied together.
int lost(double a, double b, double c, double d, const std::string& start = "{}") {
  const auto number = [](double x) { return std::to_string(x); };
  const auto bar = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  };
  const auto joint = [&number](const std::string& name, const std::string& parent, const std::string& child, double x) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent + "'/><child link='" + child + "'/><origin xyz='" +
           number(x) + " 0 0'/><axis xyz='0 0 1'/></joint>";
  };
  const std::string urdf = "<robot name='bars'><link name='ground'/>" + bar("one") + bar("two") + bar("three") +
                           joint("j1", "ground", "one", 0.0) + joint("j2", "one", "two", a) + joint("j3", "ground", "three", d) +
                           "<constraint name='tie' type='position'><predecessor link='three'><origin xyz='" + number(c) +
                           " 0 0'/></predecessor><successor link='two'><origin xyz='" + number(b) +
                           " 0 0'/></successor></constraint></robot>";
  Compiled mechanism(urdf, "{duration: 1.0, initial_state: " + start + ", objective: {integral: [{signal: j1/velocity}]}}", 1e-9);
  EXPECT_TRUE(mechanism.start().ok());
  return motions_lost_to_curvature(mechanism.system.parameters(), mechanism.assembly, mechanism.equations);
}

TEST(Mobility, AFlatParallelogramMovesOnOneOfTwoBranches) { EXPECT_EQ(lost(0.3, 0.5, 0.3, 0.5), 1); }

TEST(Mobility, BarsThatAreAlwaysStretchedTurnAsOne) { EXPECT_EQ(lost(0.1, 0.2, 0.3, 0.0), 1); }

TEST(Mobility, ARegularPositionLosesNothing) {
  EXPECT_EQ(lost(0.3, 0.5, 0.3, 0.5, "{j1: {position: 0.7}, j2: {guess: -0.7}, j3: {guess: 0.7}}"), 0);
}

}  // namespace
}  // namespace codesign
