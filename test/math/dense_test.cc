// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

/// Rank 3: the last column is the sum of the first two.
Eigen::MatrixXd matrix() {
  Eigen::MatrixXd m(5, 4);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 3; ++column)
      m(row, column) = std::sin(1.0 + 2.3 * row + 5.1 * column + 0.9 * row * column);
  m.col(3) = m.col(0) + m.col(1);
  return m;
}

TEST(Dense, DecompositionsAgreeOnTheRank) {
  const Eigen::MatrixXd m = matrix();
  EXPECT_LT(singular_values(m).values[3], 1e-14);
  EXPECT_GT(singular_values(m).values[2], 1e-3);
  EXPECT_EQ(pivot_columns(m, 1e-9).rank, 3);
  EXPECT_EQ(LeastNorm(m, 1e-9).rank(), 3);
  EXPECT_EQ(least_norm(m).rank(), 3);
  EXPECT_EQ(orthogonal_complement(m, 1e-9).cols(), 2);
}

TEST(Dense, SingularVectorsGiveTheMatrixBack) {
  const Eigen::MatrixXd m = matrix();
  const SingularValues both = singular_values(m, SingularVectors::kBoth);
  ASSERT_EQ(both.U.rows(), 5);
  ASSERT_EQ(both.U.cols(), 5);
  EXPECT_LT((both.U.leftCols(4) * both.values.asDiagonal() * both.V.transpose() - m).norm(), 1e-13);
  EXPECT_EQ(singular_values(m, SingularVectors::kLeft).V.size(), 0);
  EXPECT_LT((singular_values(m, SingularVectors::kLeft).U - both.U).norm(), 1e-12);
  EXPECT_LT((singular_values(m, SingularVectors::kRight).V.leftCols(3) - both.V.leftCols(3)).norm(),
            1e-12);
}

TEST(Dense, PivotsComeLargestFirst) {
  const Eigen::MatrixXd m = matrix();
  const PivotedColumns pivots = pivot_columns(m, 1e-9);
  Eigen::Index longest = 0;
  m.colwise().norm().maxCoeff(&longest);
  EXPECT_EQ(pivots.order[0], longest);
  EXPECT_NEAR(pivots.diagonal[0], m.col(longest).norm(), 1e-14);
  EXPECT_LT(pivots.diagonal[3], 1e-13);
}

TEST(Dense, ComplementIsOrthonormalAndOrthogonalToTheColumns) {
  const Eigen::MatrixXd m = matrix(), complement = orthogonal_complement(m, 1e-9);
  EXPECT_LT((complement.transpose() * complement - Eigen::Matrix2d::Identity()).norm(), 1e-14);
  EXPECT_LT((m.transpose() * complement).norm(), 1e-13);
}

TEST(Dense, WithoutColumnsTheComplementIsTheWholeSpace) {
  EXPECT_EQ(orthogonal_complement(Eigen::MatrixXd(3, 0), 1e-9),
            Eigen::MatrixXd(Eigen::Matrix3d::Identity()));
}

TEST(Dense, SolutionsOfLeastNormAndEigenvaluesAreExact) {
  const Eigen::MatrixXd m = matrix();
  const Eigen::Vector4d x(1.0, 2.0, 3.0, 0.5);
  const Eigen::VectorXd found = least_norm(m).solve(m * x);
  EXPECT_LT((m * (found - x)).norm(), 1e-13);
  EXPECT_LT(found.norm(), x.norm());
  const Eigen::MatrixXd square = m.transpose() * m;
  const SymmetricEigen eigen = symmetric_eigen(square);
  EXPECT_NEAR(eigen.values.sum(), square.trace(), 1e-13);
  EXPECT_NEAR(eigen.values[0], 0.0, 1e-14);
  EXPECT_LT((square * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-13);
}

TEST(Dense, PrincipalMomentsDoNotDependOnTheAxes) {
  const Eigen::Vector3d moments(1.0, 2.0, 2.5);
  const double c = std::cos(0.3), s = std::sin(0.3);
  Eigen::Matrix3d R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  EXPECT_LT((principal_moments(R * moments.asDiagonal() * R.transpose()) - moments).norm(), 1e-14);
}

TEST(Dense, UpperFactorHasTheProductOfTheMatrix) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(
      7, 4, [](Eigen::Index i, Eigen::Index j) { return std::sin(double(3 * i + j * j)); });
  const Eigen::MatrixXd R = upper_factor(A);
  ASSERT_EQ(R.rows(), 4);
  EXPECT_LT((R.transpose() * R - A.transpose() * A).norm(), 1e-13);
  EXPECT_TRUE(R.isUpperTriangular(0.0));
  EXPECT_GT(R.diagonal().minCoeff(), 0.0);
  const Eigen::MatrixXd flat = upper_factor(A.topRows(2));
  ASSERT_EQ(flat.rows(), 4);
  EXPECT_LT((flat.transpose() * flat - A.topRows(2).transpose() * A.topRows(2)).norm(), 1e-13);
}

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
  for (const Eigen::Index count : {0, 1, 3, 4, 5, 200})
    expect_root(triangular_root(rows(count, 4)), rows(count, 4));
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
      EXPECT_EQ(root.root(), Eigen::MatrixXd::Zero(columns, columns)) << "begins again";
    }
}

TEST(GeneralEigen, TurnsAndStretches) {
  Eigen::Matrix3d A;
  A << 0.0, -2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 3.0;
  const GeneralEigen eigen = general_eigen(A);
  EXPECT_LT((A * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-14);
  EXPECT_NEAR(eigen.values.imag().maxCoeff(), 2.0, 1e-14);
  EXPECT_NEAR(eigen.values.real().maxCoeff(), 3.0, 1e-14);
  EXPECT_EQ(general_eigen(Eigen::MatrixXd()).values.size(), 0);
}

TEST(AboutMean, OfEachColumn) {
  Eigen::MatrixXd A(4, 2), expected(4, 2);
  A << 1.0, 10.0, 2.0, 10.0, 3.0, 10.0, 6.0, 12.0;
  expected << -2.0, -0.5, -1.0, -0.5, 0.0, -0.5, 3.0, 1.5;
  EXPECT_EQ(about_mean_of(A), expected);
  EXPECT_EQ(about_mean_of(Eigen::MatrixXd(0, 2)).cols(), 2);
}

}  // namespace

}  // namespace codesign
