// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/loop_jacobian.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "integration/linkages.h"
#include "mechanism/constants.h"

namespace codesign {
namespace {

/// Rates of the loops' rows by unit rates of all coordinates, through the motion of all links.
Eigen::MatrixXd by_motions(Compiled* c) {
  const LoopJacobian& loops = c->assembly.loops();
  const TreeLayout& tree = c->assembly.tree();
  const std::vector<double> parameters = c->system.parameters();
  Eigen::MatrixXd expected(loops.rows(), tree.size);
  VectorX<double> errors, rates;
  State<double> state = c->state;
  for (int k = 0; k < tree.size; ++k) {
    const VectorX<double> unit = VectorX<double>::Unit(tree.size, k);
    body_coordinates(c->system, c->equations.constants(),
                     link_motions(c->system.robot(), tree, parameters, c->assembly.theta(), unit),
                     &state.q, &state.v);
    c->equations.constraint_errors(state, &errors, &rates);
    expected.col(k) = loops.part_of(rates);
  }
  return expected;
}

void expect_jacobian(Compiled* c) {
  ASSERT_TRUE(c->start().ok());
  const Eigen::MatrixXd jacobian =
      c->assembly.loops().evaluate(c->system.parameters(), c->assembly.theta(), c->equations);
  EXPECT_LT((jacobian - by_motions(c)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LoopJacobian, IsTheRateOfTheRowsByEachCoordinate) {
  Compiled ring(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"), 1e-8);
  expect_jacobian(&ring);
}

TEST(LoopJacobian, OfSpatialLoopsAndCouplings) {
  Compiled ring(bricard(), let_go(bricard_start(1.2, 0.7), "turn1/velocity"), 1e-8);
  expect_jacobian(&ring);
  const std::string geared =
      robot(bar("a") + bar("b") + hinge("first", "ground", "a", "0 0 0") +
            hinge("second", "ground", "b", "0 1 0", "<mimic joint='first' multiplier='2'/>"));
  Compiled gear(geared, let_go("{first: {position: 0.3}}", "first/velocity"));
  expect_jacobian(&gear);
}

TEST(LoopJacobian, KnowsOnlyTheCoordinatesOnTheWayAroundALoop) {
  const std::string hung =
      four_bar_with(bar("bob") + hinge("bob_hinge", "coupler", "bob", "0 0 -0.6"));
  Compiled c(hung, let_go("{left_hinge: {position: 0.6}}", "bob_hinge/velocity"), 1e-8);
  ASSERT_TRUE(c.start().ok());
  EXPECT_EQ(c.assembly.loops().coordinates().size(), 3U);
  EXPECT_EQ(c.assembly.tree().size, 4);
}

TEST(LoopJacobian, ScaledItIsTheSameForALargeMechanismAndASmallOne) {
  Compiled c(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"), 1e-8);
  ASSERT_TRUE(c.start().ok());
  const SparseMatrix jacobian =
      c.assembly.loops().evaluate(c.system.parameters(), c.assembly.theta(), c.equations);
  const LoopScales scales = c.assembly.loops().scales(jacobian, c.equations);
  const Eigen::MatrixXd scaled = scales.rows.asDiagonal() * jacobian * scales.columns.asDiagonal();
  EXPECT_NEAR(scaled.cwiseAbs().maxCoeff(), 1.0, 1e-12);
}

TEST(LoopJacobian, LoopsThatShareCoordinatesAreOnePart) {
  Compiled row(four_bar_row(3), let_go("{bar0_hinge: {position: 0.6}}", "bar0_hinge/velocity"),
               1e-8);
  ASSERT_EQ(row.assembly.loops().parts().size(), 1U);
  const LoopJacobian::Part part = row.assembly.loops().parts().front();
  EXPECT_EQ(part.rows.size(), 15U);
  EXPECT_EQ(part.pairs.size(), row.system.topology().pairs.size());
  Compiled tree(double_pendulum(), let_go("{}", "elbow/velocity"));
  EXPECT_TRUE(tree.assembly.loops().parts().empty());
}

TEST(LoopJacobian, MissesAreLengthsAndAngles) {
  Compiled c(four_bar(), let_go("{left_hinge: {position: 0.6}}", "left_hinge/velocity"), 1e-8);
  ASSERT_TRUE(c.start().ok());
  const LoopJacobian& loops = c.assembly.loops();
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(c.system.layout().m);
  errors[loops.constraint_rows()[1]] = -0.002;
  errors[loops.constraint_rows()[4]] = 0.003;
  ASSERT_EQ(loops.owners(), 1U);
  const LoopMiss miss = loops.miss(0, errors, c.equations);
  EXPECT_EQ(miss.owner, loops.owner(0));
  EXPECT_EQ(miss.length, 0.002);
  EXPECT_EQ(miss.angle, 0.003);
}

}  // namespace
}  // namespace codesign
