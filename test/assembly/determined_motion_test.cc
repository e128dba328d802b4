// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "assembly/determined_motion.h"
#include "equations/generic_state.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct Moving : Compiled {
  Moving() : Compiled(double_pendulum(), let_go("{shoulder: {position: 0.6}}", "elbow/velocity")) {}

  /// Columns 0 .. n - 1 of G_z. Without friction G is linear in z.
  Eigen::MatrixXd differences() {
    Eigen::MatrixXd columns(system.layout().columns(), system.layout().n);
    VectorX<double> with, without;
    double g = 0.0;
    State<double> moved = state;
    moved.z.setZero();
    equations.residual(moved, &without, &g);
    for (int c = 0; c < system.layout().n; ++c) {
      moved.z.setZero();
      moved.z[c] = 1.0;
      equations.residual(moved, &with, &g);
      columns.col(c) = with - without;
    }
    return columns;
  }

  Eigen::MatrixXd block(int first, int count) {
    const std::vector<Eigen::Triplet<double>> entries =
        acceleration_block(system, &equations, state, first, count);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, system.layout().n);
    for (const Eigen::Triplet<double>& entry : entries)
      dense(entry.row(), entry.col()) += entry.value();
    return dense;
  }
};

TEST(AccelerationBlock, HasTheRowsThatAreAskedFor) {
  Moving c;
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  const Eigen::MatrixXd all = c.differences();
  const int n = c.system.layout().n, m = c.system.layout().constraints();
  EXPECT_LT((c.block(0, n) - all.topRows(n)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((c.block(n, m) - all.middleRows(n, m)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((c.block(3, 5) - all.middleRows(3, 5)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_GT(all.middleRows(3, 5).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(AccelerationBlock, OfTheConstraintsIsTheirJacobian) {
  Moving c;
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  VectorX<double> Phi, Phi_rate;
  c.state.v = waves(c.state.v.size(), 0.7);
  c.equations.constraint_errors(c.state, &Phi, &Phi_rate);
  const Eigen::MatrixXd Phi_q = constraint_jacobian(c.system, &c.equations, c.state);
  ASSERT_EQ(Phi_q.rows(), Phi.size());
  EXPECT_LT((Phi_q * c.state.v - Phi_rate).cwiseAbs().maxCoeff(), 1e-10);
}

std::string link(const std::string& name, const std::string& mass, const std::string& inertia,
                 const std::string& centre) {
  const std::string zero = "' ixy='0' ixz='0' iyz='0' iyy='";
  return "<link name='" + name + "'><inertial><origin xyz='" + centre + "'/><mass value='" + mass +
         "'/><inertia ixx='" + inertia + zero + inertia + "' izz='" + inertia +
         "'/></inertial></link>\n";
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& xyz, const std::string& axis = "0 1 0",
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='" + xyz + "'/><axis xyz='" + axis + "'/>" +
         more + "</joint>\n";
}

Problem load(const std::string& content) {
  return load_mechanism(
      {"t.urdf", "<robot name='t'>\n<link name='ground'/>\n" + content + "</robot>"}, {});
}

std::string fault_of(const std::string& content) {
  try {
    load(content);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Acceleration of a joint at rest at the start.
double acceleration(const std::string& content, const std::string& name) {
  const Problem problem = load(content);
  Simulation simulation = simulation_of(system_of(problem), problem.parameters(),
                                        {parse_signal(name + "/acceleration", {}, "")});
  EXPECT_TRUE(simulation.start().ok());
  Frame frame;
  simulation.sample(0.0, &frame);
  return frame.signals.at(0);
}

constexpr double kGravity = 9.81;

TEST(DeterminedMotion, APointOnAnArmIsAPendulum) {
  EXPECT_NEAR(
      acceleration(link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0"), "j"),
      kGravity / 0.5, 1e-9);
}

TEST(DeterminedMotion, APointOnItsAxisIsNot) {
  const std::string fault =
      fault_of(link("a", "2", "0", "0 0.3 0") + joint("j", "ground", "a", "0 0 0"));
  EXPECT_NE(fault.find("t.urdf:3: <link name=\"a\">: nothing with inertia resists the link turning "
                       "about the axis (0 1 0) of joint 'j'"),
            std::string::npos)
      << fault;
}

TEST(DeterminedMotion, ARotorWithoutMass) {
  EXPECT_EQ(
      acceleration(link("a", "0", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0"), "j"),
      0.0);
  // The massless link is on an arm and can turn relative to it. Acceleration of the arm: m g l / (m
  // l^2 + J).
  const std::string arm = link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  EXPECT_NEAR(
      acceleration(arm + link("r", "0", "0.1", "0 0 0") + joint("k", "a", "r", "0.5 0 0"), "j"),
      kGravity / 0.5, 1e-9);
  EXPECT_NEAR(
      acceleration(arm + link("r", "0", "0.1", "0 0 0") + joint("k", "a", "r", "0.5 0 0", "1 0 0"),
                   "j"),
      2.0 * kGravity * 0.5 / (2.0 * 0.25 + 0.1), 1e-9);
}

TEST(DeterminedMotion, AMasslessLinkBetweenSkewHingesIsCarried) {
  const std::string chain = "<link name='m'/>" + joint("j", "ground", "m", "0 0 0") +
                            link("a", "2", "0.1", "0.3 0 0.2") +
                            joint("k", "m", "a", "0.4 0 0", "0 0 1");
  EXPECT_EQ(fault_of(chain), "");
  // About j alone, k held by symmetry: the centre lies in the x-z plane 0.7 and 0.2 away.
  EXPECT_NEAR(acceleration(chain, "j"), 2.0 * kGravity * 0.7 / (2.0 * (0.49 + 0.04) + 0.1), 1e-9);
}

TEST(DeterminedMotion, APointBehindTwoStretchedMasslessLinks) {
  const std::string fault =
      fault_of("<link name='m'/>" + joint("j", "ground", "m", "0 0 0") +
               link("a", "2", "0", "0.3 0 0") + joint("k", "m", "a", "0.4 0 0"));
  EXPECT_NE(fault.find("not determined at the start"), std::string::npos);
  EXPECT_NE(fault.find("j: "), std::string::npos);
  EXPECT_NE(fault.find("k: 1"), std::string::npos) << fault;
}

TEST(DeterminedMotion, ACouplingCarriesWhatHasNoMass) {
  const std::string arm = link("a", "2", "0", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  const std::string finger = "<link name='f'/>" + joint("lead", "ground", "f", "0 0 0");
  const std::string follower =
      link("a", "2", "0", "0.5 0 0") +
      joint("j", "ground", "a", "0 0 0", "0 1 0", "<mimic joint='lead' multiplier='-1'/>");
  EXPECT_EQ(fault_of(finger + follower), "");
  EXPECT_NEAR(acceleration(finger + follower, "lead"), -kGravity / 0.5, 1e-9);
}

TEST(DeterminedMotion, ANegativeMassOnAHeavyArmIsWhatItSays) {
  const std::string arm = link("a", "2", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0");
  EXPECT_EQ(fault_of(arm + link("b", "-0.1", "0.01", "0 0 0.1") + joint("k", "a", "b", "0.5 0 0")),
            "");
  EXPECT_NE(fault_of(link("a", "-2", "0.1", "0.5 0 0") + joint("j", "ground", "a", "0 0 0")), "");
}

}  // namespace

}  // namespace codesign
