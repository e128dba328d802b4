// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/lu_schedule.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "sparse/pivots.h"

namespace codesign {
namespace {

// The matrix [2 0 1; 4 3 0; 0 6 5] by columns; in this order of pivots its U has a fill at (1, 2).
const std::vector<int> kStart{0, 2, 4, 6}, kRows{0, 1, 1, 2, 0, 2};
const LuPattern kPattern{{0, 1, 2}, {0, 1, 2}, {2.0, 1.0, 4.0}, {{}, {}, {0, 1}}, {{1}, {2}, {}}};

Eigen::Matrix3d matrix(double corner) {
  Eigen::Matrix3d m;
  m << 2, 0, 1, 4, 3, 0, 0, 6, corner;
  return m;
}

std::vector<double> values(double corner) { return {2.0, 4.0, 3.0, 6.0, 1.0, corner}; }

/// With machine code, if available, and with loops.
class LuScheduleTest : public ::testing::TestWithParam<bool> {};

TEST_P(LuScheduleTest, SolvesForOneAndForSeveralRightHandSides) {
  LuSchedule lu(kPattern, kStart, kRows, GetParam());
  for (double corner : {5.0, -1.0}) {
    const LuSchedule::Quality quality = lu.refactor(values(corner));
    EXPECT_GT(quality.pivot_ratio, 0.0);
    EXPECT_LT(quality.growth, 10.0);
    const Eigen::Vector3d b(1, 2, 3);
    Eigen::Vector3d x = b, y = b;
    lu.solve<1>(x);
    lu.solve_transposed<1>(y);
    EXPECT_LT((matrix(corner) * x - b).norm(), 1e-13);
    EXPECT_LT((matrix(corner).transpose() * y - b).norm(), 1e-13);
    Eigen::Matrix<double, 8, 3> many = Eigen::Matrix<double, 8, 1>::LinSpaced(1.0, 8.0) *
                                       b.transpose(),
                                transposed = many;
    lu.solve<8>(many);
    lu.solve_transposed<8>(transposed);
    for (int k = 0; k < 8; ++k) {
      EXPECT_LT((many.row(k).transpose() - (k + 1.0) * x).norm(), 1e-12);
      EXPECT_LT((transposed.row(k).transpose() - (k + 1.0) * y).norm(), 1e-12);
    }
  }
}

TEST_P(LuScheduleTest, EliminatesMoreProductsThanAreListed) {
  constexpr int n = 250;  // n^3/3 products
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [](Eigen::Index r, Eigen::Index c) {
    return std::sin(static_cast<double>(3 * r + 7 * c + r * c)) + (r == c ? 40.0 : 0.0);
  });
  std::vector<int> start{0}, rows;
  for (int c = 0; c < n; ++c) {
    for (int r = 0; r < n; ++r) rows.push_back(r);
    start.push_back(static_cast<int>(rows.size()));
  }
  const std::optional<LuPattern> pattern = choose_pivots(start, rows, {A.data(), A.size()});
  ASSERT_TRUE(pattern.has_value());
  EXPECT_GT(count_products(*pattern), 4000000);
  LuSchedule lu(*pattern, start, rows, GetParam());
  for (int time = 0; time < 2; ++time) {
    const LuSchedule::Quality quality = lu.refactor({A.data(), A.size()});
    EXPECT_GT(quality.pivot_ratio, 0.1);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
    Eigen::VectorXd x = b;
    lu.solve<1>(x);
    EXPECT_LT((A * x - b).norm(), 1e-12);
  }
}

TEST_P(LuScheduleTest, AVanishedPivotIsNoQuality) {
  LuSchedule lu(kPattern, kStart, kRows, GetParam());
  // The last pivot is corner + 4.
  const LuSchedule::Quality quality = lu.refactor(values(-4.0));
  EXPECT_FALSE(quality.growth <= 1e6 && quality.pivot_ratio > 1e-17);
}

TEST_P(LuScheduleTest, TakesFillAndPermutationsOfALargeMatrix) {
  constexpr int n = 60;
  std::srand(5);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  // Some diagonal entries are zero, so that rows and columns must be exchanged.
  for (int row = 0; row < n; ++row)
    for (int k = 0; k < 4; ++k)
      A(row, (7 * row + 13 * k * k + row / 3) % n) += 1.0 + 0.1 * Eigen::internal::random<double>();
  A.diagonal().tail(n / 2).array() += 5.0;
  std::vector<int> start{0}, rows;
  std::vector<double> entries;
  for (int column = 0; column < n; ++column) {
    for (int row = 0; row < n; ++row)
      if (A(row, column) != 0.0) {
        rows.push_back(row);
        entries.push_back(A(row, column));
      }
    start.push_back(static_cast<int>(rows.size()));
  }
  const std::optional<LuPattern> pattern = choose_pivots(start, rows, entries);
  ASSERT_TRUE(pattern.has_value());
  LuSchedule lu(*pattern, start, rows, GetParam());
  for (double factor : {1.0, 0.3}) {
    for (double& entry : entries) entry *= factor;
    A *= factor;
    EXPECT_GT(lu.refactor(entries).pivot_ratio, 1e-6);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
    Eigen::VectorXd x = b, y = b;
    lu.solve<1>(x);
    lu.solve_transposed<1>(y);
    EXPECT_LT((A * x - b).norm(), 1e-11);
    EXPECT_LT((A.transpose() * y - b).norm(), 1e-11);
    Eigen::Matrix<double, 4, Eigen::Dynamic> many =
        Eigen::Vector4d(1.0, 2.0, 3.0, 4.0) * b.transpose();
    lu.solve<4>(many);
    EXPECT_LT((many.row(2).transpose() - 3.0 * x).norm(), 1e-11);
  }
}

INSTANTIATE_TEST_SUITE_P(MachineCodeAndLoops, LuScheduleTest, ::testing::Bool());

}  // namespace
}  // namespace codesign
