// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparse_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace codesign {
namespace {

// A full 4 x 4 pattern, column by column.
const std::vector<int> kLuStart{0, 4, 8, 12, 16},
    kLuRows{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};

Eigen::Matrix4d dense_matrix(double corner) {
  Eigen::Matrix4d m;
  m << corner, 2, 0, 1, 2, 5, 1, 0, 0, 1, 3, 4, 1, 0, 4, 0;
  return m;
}

TEST(SparseLu, SolvesAndRefactors) {
  SparseLu lu(kLuStart, kLuRows);
  for (double corner : {4.0, 3.0, -2.0}) {
    const Eigen::Matrix4d m = dense_matrix(corner);
    ASSERT_TRUE(lu.factor(m));
    const Eigen::Vector4d b(1, 2, 3, 4);
    Eigen::Vector4d x = b, y = b;
    lu.solve(x);
    lu.solve_transposed_rows<1>(y);
    EXPECT_LT((m * x - b).norm(), 1e-13);
    EXPECT_LT((m.transpose() * y - b).norm(), 1e-13);
  }
  EXPECT_EQ(lu.full_factorizations(), 1);
}

TEST(SparseLu, FallsBackWhenOldPivotsVanish) {
  SparseLu lu(kLuStart, kLuRows);
  ASSERT_TRUE(lu.factor(dense_matrix(1e8)));
  Eigen::Matrix4d m = dense_matrix(0.0);
  m(1, 1) = 0.0;
  ASSERT_TRUE(lu.factor(m));
  Eigen::Vector4d x(1, 2, 3, 4);
  const Eigen::Vector4d b = x;
  lu.solve(x);
  EXPECT_LT((m * x - b).norm(), 1e-12);
  EXPECT_EQ(lu.full_factorizations(), 2);

  // Both choices of pivots are kept by now.
  for (double corner : {1e8, 4.0}) {
    ASSERT_TRUE(lu.factor(dense_matrix(corner)));
    ASSERT_TRUE(lu.factor(m));
  }
  EXPECT_EQ(lu.full_factorizations(), 2);
}

TEST(SparseLu, AfterForgettingNothingDependsOnEarlierMatrices) {
  const Eigen::Matrix4d first = dense_matrix(1e8), second = dense_matrix(0.3);
  const auto solution = [](SparseLu* lu, const Eigen::Matrix4d& m) {
    Eigen::Vector4d x(1.0 / 3, 2.0 / 7, 3.0 / 11, 4.0 / 13);
    EXPECT_TRUE(lu->factor(m));
    lu->solve(x);
    return x;
  };
  SparseLu fresh(kLuStart, kLuRows), used(kLuStart, kLuRows);
  const Eigen::Vector4d expected = solution(&fresh, second);
  EXPECT_EQ(solution(&used, 2.0 * second), 0.5 * expected) << "the same pivots with other scales";
  solution(&used, first);
  for (int k = 0; k < 12; ++k) {
    used.reset_pivots();
    EXPECT_EQ(solution(&used, second), expected) << k;
    used.reset_pivots();
    solution(&used, dense_matrix(1e8 * (k + 1)));
  }
  EXPECT_GE(used.full_factorizations(), 25) << "chosen again each time";
}

TEST(SparseLu, AfterForgettingSettledPivotsAreUsedAgain) {
  const Eigen::Vector4d b(1.0 / 3, 2.0 / 7, 3.0 / 11, 4.0 / 13);
  const auto solution = [&b](SparseLu* lu, const Eigen::Matrix4d& m) {
    Eigen::Vector4d x = b;
    EXPECT_TRUE(lu->factor(m));
    lu->solve(x);
    return x;
  };
  SparseLu fresh(kLuStart, kLuRows), used(kLuStart, kLuRows);
  for (SparseLu* lu : {&fresh, &used}) {
    solution(lu, dense_matrix(4.0));
    lu->keep_pivots();
  }
  const Eigen::Vector4d expected = solution(&fresh, dense_matrix(0.3));
  for (int k = 0; k < 12; ++k) {
    used.reset_pivots();
    solution(&used, dense_matrix(1e8 * (k + 1)));
    used.reset_pivots();
    EXPECT_EQ(solution(&used, dense_matrix(0.3)), expected) << k;
  }
  EXPECT_EQ(fresh.full_factorizations(), 1) << "the kept pivots serve";
}

TEST(SparseLu, TakesTheSettledPivotsOfAnother) {
  const Eigen::Vector4d b(1.0 / 3, 2.0 / 7, 3.0 / 11, 4.0 / 13);
  SparseLu first(kLuStart, kLuRows), other(kLuStart, kLuRows);
  EXPECT_TRUE(first.factor(dense_matrix(4.0)));
  other.keep_pivots_of(first);
  first.keep_pivots();
  other.keep_pivots_of(first);
  EXPECT_TRUE(other.factor(dense_matrix(0.3)));
  EXPECT_TRUE(first.factor(dense_matrix(0.3)));
  EXPECT_EQ(other.full_factorizations(), 0);
  Eigen::Vector4d x = b, y = b;
  first.solve(x);
  other.solve(y);
  EXPECT_EQ(x, y);

  // Its own kept pivots stay.
  SparseLu third(kLuStart, kLuRows);
  EXPECT_TRUE(third.factor(dense_matrix(1e8)));
  third.keep_pivots();
  third.keep_pivots_of(first);
  third.reset_pivots();
  EXPECT_TRUE(third.factor(dense_matrix(1e8)));
  EXPECT_EQ(third.full_factorizations(), 1);
}

/// D m E with the units of other rows and columns.
Eigen::Matrix4d in_units(const Eigen::Matrix4d& m, const Eigen::Vector4d& rows,
                         const Eigen::Vector4d& columns) {
  return rows.asDiagonal() * m * columns.asDiagonal();
}

// A body of little mass that slides without friction, whose multiplier has the unit of a force.
Eigen::Matrix4d saddle(double mass, double second) {
  Eigen::Matrix4d m;
  m << mass, 0, 0, 0.6, 0, mass, 0, 0.8, 0, 0, second, 0.3, 0.6, 0.8, 0.3, 0;
  return m;
}

TEST(SparseLu, SmallPivotsAreNoSingularMatrix) {
  for (const double mass : {1e-12, 1e-26, 1e-60, 1e60}) {
    SparseLu lu(kLuStart, kLuRows);
    ASSERT_TRUE(lu.factor(saddle(mass, 3.0 * mass))) << mass;
    const Eigen::Vector4d b(mass, 2.0 * mass, 3.0 * mass, 1.0);
    Eigen::Vector4d x = b;
    lu.solve(x);
    SparseLu usual(kLuStart, kLuRows);
    ASSERT_TRUE(usual.factor(saddle(1.0, 3.0)));
    Eigen::Vector4d expected(1.0, 2.0, 3.0, 1.0);
    usual.solve(expected);
    expected[3] *= mass;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(x[k] / expected[k], 1.0, 1e-12) << mass << ' ' << k;
    for (int k = 1; k < 5; ++k) ASSERT_TRUE(lu.factor(saddle(mass, (3.0 + 0.1 * k) * mass)));
    EXPECT_EQ(lu.full_factorizations(), 1) << "the pivots serve on";
  }
}

TEST(SparseLu, MatricesWithoutAnInverseAreSingularInAnyUnits) {
  Eigen::Matrix4d m = dense_matrix(4.0);
  m.row(3) = 0.3 * m.row(0) + 0.7 * m.row(1) - 1.3 * m.row(2);
  m.col(3) = m.col(0) + m.col(2);
  for (const double unit : {1e-3, 1e-9, 1e-15, 1e-40, 1e20}) {
    SparseLu lu(kLuStart, kLuRows);
    EXPECT_FALSE(lu.factor(
        in_units(m, Eigen::Vector4d(1, 1, unit, unit * unit), Eigen::Vector4d(1, 1, unit, unit))))
        << unit;
  }
}

TEST(SparseLu, ReportsSingularMatrices) {
  SparseLu lu(kLuStart, kLuRows);
  Eigen::Matrix4d m = dense_matrix(4.0);
  m.col(3) = m.col(2);
  EXPECT_FALSE(lu.factor(m));
  EXPECT_TRUE(lu.factor(dense_matrix(4.0)));
}

}  // namespace
}  // namespace codesign
