// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/inverse_dynamics.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "equations/formulas.h"
#include "math/arrays.h"

namespace codesign {
namespace {

/// The tree of one joint of a mechanism in absolute coordinates, with the poses of its joints from
/// the axes of the bodies.
struct Driven : Compiled {
  Driven(const std::string& urdf, const std::string& study, int pair, bool accelerations)
      : Compiled(urdf, study),
        tree(driven_tree(system.topology(), pair, accelerations, {}, "")),
        inverse(tree) {
    EXPECT_TRUE(start().ok());
    equations.formulas().load(state);
    for (DrivenTree::Node& node : tree.nodes) node.rotor = !system.rotors().empty() && node.moved;
    for (int body = 0; body < system.layout().bodies; ++body)
      bodies.push_back(equations.formulas().body(body));
    bodies.push_back(equations.formulas().body(-1));
  }

  double load(const std::vector<double>& accelerations) {
    const Formulas<double>& formulas = equations.formulas();
    for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
      const int pair = tree.nodes[k].pair, i = system.topology().pairs[to_index(pair)].body_i;
      const CoordinateMotion<double>& motion = formulas.coordinate(pair, 0);
      inverse.joint(k) = {joint_pose_of(formulas.body(i).A, formulas.body(tree.nodes[k].body).A),
                          motion.position, motion.rate, accelerations[k]};
    }
    return inverse.load(equations.constants(), {0.0, 0.0, -9.81});
  }

  DrivenTree tree;
  InverseDynamics<double> inverse;
  std::vector<BodyKinematics<double>> bodies;
};

/// The double pendulum at a start, with the tree of its shoulder.
struct Shoulder : Driven {
  explicit Shoulder(bool accelerations, const std::string& actuator = "",
                    const std::string& rates = "2.0, -1.0")
      : Driven(double_pendulum(actuator),
               let_go("{shoulder: {position: 0.3, velocity: " + rates.substr(0, rates.find(',')) +
                          "}, elbow: {position: 0.5, velocity: " +
                          rates.substr(rates.find(',') + 2) + "}}",
                      "elbow/position"),
               0, accelerations) {}
};

TEST(InverseDynamics, AtRestItIsTheMomentOfTheWeights) {
  const Shoulder s(false);
  EXPECT_NEAR(gravity_load(s.tree, s.equations.constants(), s.bodies, {0.0, 0.0, -9.81}),
              9.81 * (0.5 * std::sin(0.3) + std::sin(0.3) + 0.5 * std::sin(0.8)), 1e-12);
}

// Textbook double pendulum, bars of 1 kg, 1 m, J = 0.0834 about their centres, relative angles.
TEST(InverseDynamics, InMotionItIsTheTextbooks) {
  Shoulder s(true);
  const double w1 = 2.0, w2 = -1.0, J = 0.0834, c = std::cos(0.5), half = 0.5 * std::sin(0.5);
  const double gravity = 9.81 * (0.5 * std::sin(0.3) + std::sin(0.3) + 0.5 * std::sin(0.8));
  const double velocity_terms = -half * w2 * w2 - 2.0 * half * w1 * w2;
  EXPECT_NEAR(s.load({0.0, 0.0}), gravity + velocity_terms, 1e-12);
  const double M11 = 2.0 * J + 0.25 + 1.0 + 0.25 + c, M12 = J + 0.25 + 0.5 * c;
  EXPECT_NEAR(s.load({3.0, -4.0}), gravity + velocity_terms + 3.0 * M11 - 4.0 * M12, 1e-12);
}

// With parallel axes each rotor needs J_r (n theta'' + w'). Through the gear the shoulder's own
// rotor adds n^2 J_r; the elbow's rotor, which the upper bar carries, adds n J_r.
TEST(InverseDynamics, RotorsAddTheirShareOfTheMassMatrix) {
  for (const char* rates : {"2.0, -1.0", "5.0, 7.0"}) {
    Shoulder plain(true, "", rates),
        geared(true, "<codesign:actuator gear_ratio='5' rotor_inertia='0.004'/>", rates);
    const double expected = plain.load({3.0, -4.0}) + 25.0 * 0.004 * 3.0 + 5.0 * 0.004 * -4.0;
    EXPECT_NEAR(geared.load({3.0, -4.0}), expected, 1e-12) << "the axes do not swing";
  }
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& axis) {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child +
         "'/><origin xyz='0.1 -0.2 -0.7' rpy='0.3 -0.2 0.5'/><axis xyz='" + axis +
         "'/><limit effort='0' velocity='0'/>" +
         "<codesign:actuator gear_ratio='-8' rotor_inertia='0.003'/></joint>";
}

// The rows of motion of the joint coordinates are the loads that the joints lack.
TEST(InverseDynamics, WithSkewAxesSlidesAndRotorsItIsTheResidualInJointCoordinates) {
  const std::string urdf = robot(bar("a") + bar("b") + bar("c") + bar("d") +
                                 joint("turn", "continuous", "ground", "a", "0.2 0.1 1") +
                                 joint("reach", "prismatic", "a", "b", "1 0.5 -0.3") +
                                 joint("wrist", "continuous", "b", "c", "0 1 0.4") +
                                 joint("grip", "prismatic", "b", "d", "0.1 1 0.2"));
  const std::string start =
      "{turn: {position: 0.3, velocity: 2.0}, reach: {position: 0.2, velocity: -1.5}, wrist: "
      "{position: -0.7, velocity: 3.0}, "
      "grip: {position: 0.1, velocity: 1.0}}";
  const double some[] = {1.0, -2.0, 3.0, 0.5};
  Compiled joints(urdf, let_go(start, "turn/position", "solver: {coordinates: joint}\n"));
  ASSERT_TRUE(joints.start().ok());
  ASSERT_EQ(joints.system.layout().n, 4);
  for (int k = 0; k < 4; ++k) joints.state.z[k] = some[k];
  VectorX<double> G;
  double g = 0.0;
  joints.equations.residual(joints.state, &G, &g);
  for (int k = 0; k < 4; ++k) {
    Driven driven(urdf, let_go(start, "turn/position"), k, true);
    std::vector<double> accelerations;
    for (const DrivenTree::Node& node : driven.tree.nodes) accelerations.push_back(some[node.pair]);
    EXPECT_NEAR(driven.load(accelerations), G[k], 1e-11) << k;
  }
}

}  // namespace
}  // namespace codesign
