// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/lu_schedule.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

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

TEST(LuSchedule, SolvesForOneAndForSeveralRightHandSides) {
  LuSchedule lu(kPattern, kStart, kRows);
  for (double corner : {5.0, -1.0}) {
    const LuSchedule::Quality quality = lu.refactor(values(corner).data());
    EXPECT_GT(quality.pivot_ratio, 0.0);
    EXPECT_LT(quality.growth, 10.0);
    const Eigen::Vector3d b(1, 2, 3);
    Eigen::Vector3d x = b, y = b;
    lu.solve<1>(x.data());
    lu.solve_transposed<1>(y.data());
    EXPECT_LT((matrix(corner) * x - b).norm(), 1e-13);
    EXPECT_LT((matrix(corner).transpose() * y - b).norm(), 1e-13);
    Eigen::Matrix<double, 8, 3> many = Eigen::Matrix<double, 8, 1>::LinSpaced(1.0, 8.0) * b.transpose(), transposed = many;
    lu.solve<8>(many.data());
    lu.solve_transposed<8>(transposed.data());
    for (int k = 0; k < 8; ++k) {
      EXPECT_LT((many.row(k).transpose() - (k + 1.0) * x).norm(), 1e-12);
      EXPECT_LT((transposed.row(k).transpose() - (k + 1.0) * y).norm(), 1e-12);
    }
  }
}

TEST(LuSchedule, AVanishedPivotIsNoQuality) {
  LuSchedule lu(kPattern, kStart, kRows);
  // The last pivot is corner + 4.
  const LuSchedule::Quality quality = lu.refactor(values(-4.0).data());
  EXPECT_FALSE(quality.growth <= 1e6 && quality.pivot_ratio > 1e-17);
}

}  // namespace
}  // namespace codesign
