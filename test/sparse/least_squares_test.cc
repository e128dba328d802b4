// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

/// A matrix with `size` independent columns of three numbers each in a band, followed by columns that are sums of neighbours.
SparseMatrix band(int size, int sums) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int column, int k) {
    for (int r = 0; r < 3; ++r) entries.emplace_back(k + r, column, std::sin(1.3 * k + r) + (r == 0 ? 2.0 : 0.0));
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
