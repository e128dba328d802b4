// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "assembly/acceleration_block.h"

#include <gtest/gtest.h>

#include "equations/generic_state.h"

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
    const std::vector<Eigen::Triplet<double>> entries = acceleration_block(system, &equations, state, first, count);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, system.layout().n);
    for (const Eigen::Triplet<double>& entry : entries) dense(entry.row(), entry.col()) += entry.value();
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

}  // namespace
}  // namespace codesign
