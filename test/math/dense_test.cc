// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/dense.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// Rank 3: the last column is the sum of the first two.
Eigen::MatrixXd matrix() {
  Eigen::MatrixXd m(5, 4);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 3; ++column) m(row, column) = std::sin(1.0 + 2.3 * row + 5.1 * column + 0.9 * row * column);
  m.col(3) = m.col(0) + m.col(1);
  return m;
}

TEST(Dense, DecompositionsAgreeOnTheRank) {
  const Eigen::MatrixXd m = matrix();
  const Eigen::VectorXd values = Eigen::BDCSVD<Eigen::MatrixXd>(m).singularValues();
  EXPECT_LT((values - Eigen::JacobiSVD<Eigen::MatrixXd>(m).singularValues()).norm(), 1e-14);
  EXPECT_LT(values[3], 1e-14);
  EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(m).rank(), 3);
  EXPECT_EQ(Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(m).rank(), 3);
}

TEST(Dense, SolutionsOfLeastNormAndEigenvaluesAreExact) {
  const Eigen::MatrixXd m = matrix();
  const Eigen::Vector4d x(1.0, 2.0, 3.0, 0.5);
  const Eigen::VectorXd found = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(m).solve(m * x);
  EXPECT_LT((m * (found - x)).norm(), 1e-13);
  EXPECT_LE(found.norm(), x.norm());
  const Eigen::MatrixXd square = m.transpose() * m;
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(square).eigenvalues();
  EXPECT_NEAR(values.sum(), square.trace(), 1e-13);
  EXPECT_NEAR(values[0], 0.0, 1e-14);
}

}  // namespace
}  // namespace codesign
