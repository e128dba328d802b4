// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "math/dense.h"
#include "sparse/least_squares.h"

namespace codesign {
namespace {

/// A matrix with three numbers per column in a band. Columns are independent, except that column k
/// is the sum of the two before if k % 7
/// == 3.
SparseMatrix band(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int column, int k) {
    for (int r = 0; r < 3; ++r)
      entries.emplace_back(k + r, column, std::sin(1.3 * k + r) + (r == 0 ? 2.0 : 0.0));
  };
  for (int k = 0; k < size; ++k) {
    if (k % 7 != 3) {
      add(k, k);
      continue;
    }
    add(k, k - 1);
    add(k, k - 2);
  }
  SparseMatrix A(size + 2, size);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

Eigen::MatrixXd right_sides(Eigen::Index rows) {
  return Eigen::MatrixXd::NullaryExpr(rows, 2, [](Eigen::Index r, Eigen::Index c) {
    return std::cos(0.7 * static_cast<double>(r + 3 * c));
  });
}

TEST(SparseQr, FindsTheColumnsThatFollowFromEarlierOnes) {
  const int size = 700;
  SparseQr qr;
  qr.factor(band(size), 1e-9, SparseQr::Ordering::kNatural);
  std::vector<int> expected;
  for (int k = 3; k < size; k += 7) expected.push_back(k);
  EXPECT_EQ(qr.dependent(), expected);
  qr.factor(band(size), 1e-9);
  EXPECT_EQ(qr.dependent().size(), expected.size())
      << "another ordering finds as many, if not the same";
}

TEST(SparseQr, SolutionsAreThoseOfLeastSquaresWithoutDependentColumns) {
  const SparseMatrix A = band(60);
  const Eigen::MatrixXd b = right_sides(A.rows());
  SparseQr qr;
  for (const SparseQr::Ordering ordering :
       {SparseQr::Ordering::kNatural, SparseQr::Ordering::kFillReducing}) {
    qr.factor(A, 1e-9, ordering);
    const Eigen::MatrixXd x = qr.solve(b), shortest = least_norm(Eigen::MatrixXd(A)).solve(b);
    EXPECT_LT((A * (x - shortest)).cwiseAbs().maxCoeff(), 1e-12)
        << "the point of the columns' span nearest to b is one";
    for (int column : qr.dependent()) EXPECT_EQ(x.row(column).norm(), 0.0);
  }
}

TEST(SparseQr, OfFullRankHasNoDependentColumns) {
  SparseMatrix A(4, 3);
  A.insert(0, 0) = 2.0;
  A.insert(1, 1) = 3.0;
  A.insert(3, 2) = 4.0;
  A.insert(0, 2) = 1.0;
  A.makeCompressed();
  SparseQr qr;
  EXPECT_TRUE(qr.dependent().empty());
  qr.factor(A, 1e-9);
  EXPECT_TRUE(qr.dependent().empty());
  const Eigen::Vector4d b(4.0, 6.0, 5.0, 8.0);
  EXPECT_LT((qr.solve(b) - Eigen::Vector3d(1.0, 2.0, 2.0)).norm(), 1e-14);
}

/// A matrix with `size` independent columns of three numbers each in a band, followed by columns
/// that are sums of neighbours.
SparseMatrix band(int size, int sums) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int column, int k) {
    for (int r = 0; r < 3; ++r)
      entries.emplace_back(k + r, column, std::sin(1.3 * k + r) + (r == 0 ? 2.0 : 0.0));
  };
  for (int k = 0; k < size; ++k) add(k, k);
  for (int k = 0; k < sums; ++k) add(size + k, k), add(size + k, k + 1);
  SparseMatrix A(size + 2, size + sums);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

class LeastSquaresOfSize : public ::testing::TestWithParam<int> {};

TEST_P(LeastSquaresOfSize, LeavesWhatNoColumnReaches) {
  const SparseMatrix A = band(GetParam(), 3);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index k = 0; k < b.size(); ++k) b[k] = std::cos(0.7 * static_cast<double>(k));
  LeastSquares least;
  least.factor(A, 1e-9);
  const Eigen::VectorXd left = b - A * least.solve(b);
  EXPECT_GT(left.norm(), 1e-3);
  EXPECT_LT((A.transpose() * left).norm(), 1e-9 * b.norm());
}

TEST_P(LeastSquaresOfSize, SumsOfOthersAreDependent) {
  const int size = GetParam();
  const SparseMatrix A = band(size, 3);
  EXPECT_EQ(dependent_columns(A, 1e-6).size(), 3U);
  EXPECT_TRUE(dependent_columns(band(size, 0), 1e-6).empty());
}

TEST_P(LeastSquaresOfSize, EarlierPreferencesComeFirst) {
  const int size = GetParam();
  const SparseMatrix A = band(size, 3);
  ColumnPreferences preferences(2);
  for (int k = 0; k < 3; ++k) preferences[0].push_back(size + k);
  for (int k = 0; k < size; ++k) preferences[1].push_back(k);
  const std::vector<int> chosen = independent_columns(A, preferences, 1e-9);
  ASSERT_EQ(chosen.size(), static_cast<std::size_t>(size));
  EXPECT_EQ(std::vector<int>(chosen.end() - 3, chosen.end()), preferences[0]);
  EXPECT_TRUE(dependent_columns(columns_of(A, chosen), 1e-9).empty());
}

// Sizes below and above the one from which the factorization is sparse.
INSTANTIATE_TEST_SUITE_P(Sizes, LeastSquaresOfSize, ::testing::Values(8, 600));

TEST(LeastSquares, OfNothingIsNothing) {
  LeastSquares least;
  least.factor(SparseMatrix(0, 3), 1e-9);
  EXPECT_EQ(least.solve(Eigen::MatrixXd(0, 2)), Eigen::MatrixXd(Eigen::MatrixXd::Zero(3, 2)));
  EXPECT_EQ(dependent_columns(SparseMatrix(0, 2), 1e-9), (std::vector<int>{0, 1}));
}

}  // namespace

}  // namespace codesign
