// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/inverse_dynamics.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"

namespace codesign {
namespace {

/// The double pendulum at a start, with the tree of its shoulder.
struct Shoulder : Compiled {
  explicit Shoulder(bool accelerations, const std::string& actuator = "")
      : Compiled(double_pendulum(actuator),
                 let_go("{shoulder: {position: 0.3, velocity: 2.0}, elbow: {position: 0.5, velocity: -1.0}}", "elbow/position")),
        tree(driven_tree(system.topology(), system.topology().joint_pair[0], accelerations, {}, "")),
        inverse(tree) {
    EXPECT_TRUE(start().ok());
    equations.formulas().load(state);
    bodies = {equations.formulas().body(0), equations.formulas().body(1), equations.formulas().body(-1)};
  }

  double load(In<double> accelerations, In<double> rates = {}) {
    return inverse.load(equations.constants(), bodies, {0.0, 0.0, -9.81}, accelerations, rates);
  }

  DrivenTree tree;
  InverseDynamics<double> inverse;
  std::vector<BodyKinematics<double>> bodies;
};

TEST(InverseDynamics, AtRestItIsTheMomentOfTheWeights) {
  Shoulder s(false);
  EXPECT_NEAR(s.load({}), 9.81 * (0.5 * std::sin(0.3) + std::sin(0.3) + 0.5 * std::sin(0.8)), 1e-12);
}

// Textbook double pendulum, bars of 1 kg, 1 m, J = 0.0834 about their centres, relative angles.
TEST(InverseDynamics, InMotionItIsTheTextbooks) {
  Shoulder s(true);
  const double w1 = 2.0, w2 = -1.0, J = 0.0834, c = std::cos(0.5), half = 0.5 * std::sin(0.5);
  const double gravity = 9.81 * (0.5 * std::sin(0.3) + std::sin(0.3) + 0.5 * std::sin(0.8));
  const double velocity_terms = -half * w2 * w2 - 2.0 * half * w1 * w2;
  const double none[2] = {0.0, 0.0}, some[2] = {3.0, -4.0};
  EXPECT_NEAR(s.load(none), gravity + velocity_terms, 1e-12);
  const double M11 = 2.0 * J + 0.25 + 1.0 + 0.25 + c, M12 = J + 0.25 + 0.5 * c;
  EXPECT_NEAR(s.load(some), gravity + velocity_terms + 3.0 * M11 - 4.0 * M12, 1e-12);
}

// With parallel axes each rotor needs J_r (n theta'' + w'). Through the gear the shoulder's own rotor adds n^2 J_r; the elbow's rotor,
// which the upper bar carries, adds n J_r.
TEST(InverseDynamics, RotorsAddTheirShareOfTheMassMatrix) {
  Shoulder plain(true), geared(true, "<codesign:actuator gear_ratio='5' rotor_inertia='0.004'/>");
  for (DrivenTree::Node& node : geared.tree.nodes) node.rotor = true;
  const double some[2] = {3.0, -4.0}, rates[2] = {2.0, -1.0};
  const double expected = plain.load(some) + 25.0 * 0.004 * 3.0 + 5.0 * 0.004 * -4.0;
  EXPECT_NEAR(geared.load(some, rates), expected, 1e-12);
  const double other_rates[2] = {5.0, 7.0};
  EXPECT_NEAR(geared.load(some, other_rates), expected, 1e-12) << "the axes do not swing";
}

}  // namespace
}  // namespace codesign
