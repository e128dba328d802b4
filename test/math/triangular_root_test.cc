// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/triangular_root.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Eigen::MatrixXd rows(Eigen::Index count, Eigen::Index columns) {
  std::srand(7);
  return Eigen::MatrixXd::Random(count, columns);
}

void expect_root(const Eigen::MatrixXd& R, const Eigen::MatrixXd& A) {
  ASSERT_EQ(R.rows(), A.cols());
  ASSERT_EQ(R.cols(), A.cols());
  EXPECT_LE((R.transpose() * R - A.transpose() * A).norm(), 1e-13 * A.squaredNorm());
  for (Eigen::Index k = 0; k < R.cols(); ++k) {
    EXPECT_GE(R(k, k), 0.0);
    EXPECT_TRUE((R.col(k).tail(R.rows() - k - 1).array() == 0.0).all());
  }
}

TEST(TriangularRoot, IsARootOfAnyNumberOfRows) {
  for (const Eigen::Index count : {0, 1, 3, 4, 5, 200}) expect_root(triangular_root(rows(count, 4)), rows(count, 4));
  EXPECT_EQ(triangular_root(Eigen::MatrixXd(3, 0)).size(), 0);
}

TEST(TriangularRoot, KeepsSmallSingularValuesThatASquareWouldLose) {
  // The second column differs from the first by 1e-10: squared, the difference is below rounding.
  Eigen::MatrixXd A(3, 2);
  A << 1.0, 1.0, 1.0, 1.0 + 1e-10, 1.0, 1.0 - 1e-10;
  EXPECT_NEAR(triangular_root(A)(1, 1), std::sqrt(2.0) * 1e-10, 1e-15);
}

TEST(RowRoot, IsThatOfAllRows) {
  for (const Eigen::Index columns : {1, 5, 40})
    for (const Eigen::Index count : {0, 3, 33, 72, 73, 400}) {
      const Eigen::MatrixXd A = rows(count, columns);
      RowRoot root;
      root.start(columns);
      for (Eigen::Index k = 0; k < count; ++k) root.add(A.row(k).transpose());
      expect_root(root.root(), A);
      root.start(columns);
      EXPECT_EQ(root.root(), Eigen::MatrixXd::Zero(columns, columns)) << "begins anew";
    }
}

}  // namespace
}  // namespace codesign
