// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/redundancy.h"

#include <gtest/gtest.h>

#include <set>

#include "equations/generic_state.h"
#include "integration/linkages.h"
#include "math/dense.h"

namespace codesign {
namespace {

/// A system without sharing of reactions, assembled at its start.
ReactionSharing sharing_of(const std::string& urdf, const std::string& study) {
  Compiled c(urdf, study, 1e-8);
  EXPECT_TRUE(c.start().ok());
  ReactionSharing sharing =
      analyse_redundancy(c.system, &c.equations, c.assembly, c.system.parameters(), c.state)
          .sharing;
  sharing.compliance = 1e-8;
  return sharing;
}

struct Started : Compiled {
  Started(const std::string& urdf, const std::string& initial, const std::string& signal)
      : Compiled(urdf, let_go(initial, signal), sharing_of(urdf, let_go(initial, signal))),
        status(start()) {
    if (status.ok()) Phi_q = constraint_jacobian(system, &equations, state);
  }
  Redundancy redundancy() {
    return analyse_redundancy(system, &equations, assembly, system.parameters(), state);
  }

  Status status;
  Eigen::MatrixXd Phi_q;
};

Started four_bar_at(const std::string& friction) {
  return {four_bar(friction), "{left_hinge: {position: 0.6, velocity: 1.0}}",
          "left_hinge/velocity"};
}

TEST(Redundancy, NamesJointAndKindOfRowsThatTheOthersImply) {
  Started c = four_bar_at("");
  ASSERT_TRUE(c.status.ok());
  const Redundancy r = c.redundancy();
  ASSERT_EQ(r.rows.size(), 3U);
  Eigen::MatrixXd kept = c.Phi_q;
  for (const ConstraintRow& row : r.rows) {
    // Redundant are one translation normal to the plane and two rotations out of it.
    const bool across =
        row.kind == "coincident points, ground y" || row.kind.rfind("parallel axes, ", 0) == 0;
    EXPECT_TRUE(across) << row.joint << ' ' << row.kind;
    for (std::size_t k = 0; k < c.system.topology().pairs.size(); ++k)
      if (c.system.topology().pairs[k].name == row.joint)
        kept.row(c.system.layout().pair_row[k] + row.row - 1).setZero();
  }
  // Without these rows the rank is the same.
  EXPECT_EQ(pivot_columns(kept, 1e-9).rank, c.Phi_q.rows() - 3);
  EXPECT_EQ(pivot_columns(c.Phi_q, 1e-9).rank, c.Phi_q.rows() - 3);
}

TEST(Redundancy, WithoutItNothingIsOpen) {
  Started c(double_pendulum(pin_friction()), "{shoulder: {position: 0.6}}", "elbow/velocity");
  ASSERT_TRUE(c.status.ok());
  const Redundancy r = c.redundancy();
  EXPECT_TRUE(r.rows.empty());
  EXPECT_TRUE(r.undetermined.empty());
  EXPECT_TRUE(r.friction_chosen.empty());
}

TEST(Redundancy, FrictionIsAChoiceOnlyWhereAReactionIsOpen) {
  const std::vector<std::string> ring = {"left_hinge", "right_hinge", "left_pin", "right_pin"};
  Started without = four_bar_at("");
  EXPECT_EQ(without.redundancy().undetermined, ring);
  EXPECT_TRUE(without.redundancy().friction_chosen.empty());
  Started with = four_bar_at(pin_friction());
  EXPECT_EQ(with.redundancy().friction_chosen, std::vector<std::string>{"left_hinge"})
      << "of the ring one has friction";
  // A pendulum that hangs on the ring's coupler has a reaction of its own.
  const std::string hung =
      four_bar_with(bar("bob") + hinge("bob_hinge", "coupler", "bob", "0 0 -0.6", pin_friction()));
  Started beside(hung, "{left_hinge: {position: 0.6}}", "bob_hinge/velocity");
  ASSERT_TRUE(beside.status.ok()) << beside.status.cause;
  EXPECT_EQ(beside.redundancy().rows.size(), 3U);
  EXPECT_EQ(beside.redundancy().undetermined, ring);
  EXPECT_TRUE(beside.redundancy().friction_chosen.empty());
}

TEST(Redundancy, ABricardRingHasOneRowTooManyAtItsAssembledStart) {
  Started c(bricard(), bricard_start(1.2, 0.7), "turn1/velocity");
  ASSERT_TRUE(c.status.ok()) << c.status.cause;
  const Redundancy r = c.redundancy();
  EXPECT_EQ(r.rows.size(), 1U);
  EXPECT_EQ(r.undetermined.size(), 6U) << "all six hinges share the open reaction";
}

TEST(Redundancy, RowsAreOfLoopsNeverOfTheTreeOrOfEulerParameters) {
  Started c(bricard(), bricard_start(1.2, 0.7), "turn1/velocity");
  for (const ConstraintRow& row : c.redundancy().rows) {
    EXPECT_EQ(row.joint, "turn6");
    EXPECT_NE(row.kind, "unit Euler parameters");
  }
}

TEST(Redundancy, WhatHoldsAtASingularPositionAloneIsNotDropped) {
  // All bars of the flat parallelogram lie on one line, so that a row in its plane is redundant,
  // but only at this position.
  Compiled c(
      four_bar_row(1),
      let_go(
          "{bar0_hinge: {position: 1.5707963267948966}, bar1_hinge: {guess: 1.5707963267948966}}",
          "bar0_hinge/velocity"),
      1e-8);
  ASSERT_TRUE(c.assembly
                  .solve_positions(c.system.parameters(),
                                   (c.equations.set_design(c.system.parameters()), &c.equations),
                                   &c.state)
                  .ok());
  const Redundancy r =
      analyse_redundancy(c.system, &c.equations, c.assembly, c.system.parameters(), c.state);
  EXPECT_EQ(r.rows.size(), 4U);
  EXPECT_EQ(r.sharing.dropped.size(), 3U);
}

TEST(Redundancy, ASecondMimicOfTheSameIsNamedAsOne) {
  const std::string twice =
      robot(bar("a") + bar("b") + hinge("first", "ground", "a", "0 0 0") +
            hinge("second", "ground", "b", "0 1 0", "<mimic joint='first' multiplier='2'/>") +
            "<coupling name='gear'><predecessor link='a'/><successor link='b'/><ratio "
            "value='2'/></coupling>");
  Started c(twice, "{first: {position: 0.3}}", "first/velocity");
  ASSERT_TRUE(c.status.ok());
  const Redundancy r = c.redundancy();
  ASSERT_EQ(r.rows.size(), 1U);
  EXPECT_EQ(r.rows[0].row, 1);
  const bool named = (r.rows[0].joint == "gear" && r.rows[0].kind == "coupling") ||
                     (r.rows[0].joint == "second" && r.rows[0].kind == "mimic");
  EXPECT_TRUE(named) << r.rows[0].joint << ' ' << r.rows[0].kind;
  EXPECT_EQ(r.undetermined, (std::vector<std::string>{"second", "gear"}));
}

/// Maps translation and rotation rates of the bodies to coordinate velocities, (6 per body) to n;
/// in these, the rows of unit Euler parameters have no load.
Eigen::MatrixXd rigid_motions(const Layout& layout, const State<double>& state) {
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(layout.n, 6 * layout.bodies);
  for (int b = 0; b < layout.bodies; ++b) {
    const Vector4<double> p = state.q.segment<4>(kBodySize * b + 3);
    motions.block<3, 3>(kBodySize * b, 6 * b).setIdentity();
    motions.block<4, 3>(kBodySize * b + 3, 6 * b + 3) = 0.5 * body_rate_matrix(p).transpose();
  }
  return motions;
}

void expect_least_norm(Started&& c) {
  ASSERT_TRUE(c.status.ok()) << c.status.cause;
  const Layout& layout = c.system.layout();
  const int joints = layout.norm_row(0);
  State<double> unloaded = c.state;
  unloaded.z.segment(layout.n, layout.constraints()).setZero();
  Eigen::VectorXd G;
  double g = 0.0;
  c.equations.residual(unloaded, &G, &g);
  // By Newton and Euler the total load of the reactions is known; the complete orthogonal
  // decomposition gives the reactions of least norm.
  const Eigen::MatrixXd motions = rigid_motions(layout, c.state),
                        loads = motions.transpose() * c.Phi_q.topRows(joints).transpose();
  const Eigen::VectorXd wrenches = -motions.transpose() * G.head(layout.n);
  const LeastNorm factors(loads, 1e-9);
  const Eigen::VectorXd least = factors.solve(wrenches),
                        lambda = c.state.z.segment(layout.n, joints);
  EXPECT_LT(factors.rank(), joints);
  EXPECT_LT((loads * least - wrenches).norm(), 1e-6 * wrenches.norm()) << "they balance the bodies";
  EXPECT_LT((lambda - least).norm(), 1e-6 * least.norm());
}

TEST(Redundancy, ReactionsAreThoseOfLeastNorm) {
  expect_least_norm(four_bar_at(""));
  expect_least_norm(
      {four_bar_row(3), "{bar0_hinge: {position: 0.6, velocity: 1.0}}", "bar0_hinge/velocity"});
  expect_least_norm({bricard(), bricard_start(1.2, 0.7), "turn1/velocity"});
}

}  // namespace
}  // namespace codesign
