// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparse_qr.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/dense.h"

namespace codesign {
namespace {

/// A matrix with three numbers per column in a band. Columns are independent, except that column k is the sum of the two before if k % 7
/// == 3.
SparseMatrix band(int size) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int column, int k) {
    for (int r = 0; r < 3; ++r) entries.emplace_back(k + r, column, std::sin(1.3 * k + r) + (r == 0 ? 2.0 : 0.0));
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
  return Eigen::MatrixXd::NullaryExpr(rows, 2,
                                      [](Eigen::Index r, Eigen::Index c) { return std::cos(0.7 * static_cast<double>(r + 3 * c)); });
}

TEST(SparseQr, FindsTheColumnsThatFollowFromEarlierOnes) {
  const int size = 700;
  SparseQr qr;
  qr.factor(band(size), 1e-9, SparseQr::Ordering::kNatural);
  std::vector<int> expected;
  for (int k = 3; k < size; k += 7) expected.push_back(k);
  EXPECT_EQ(qr.dependent(), expected);
  qr.factor(band(size), 1e-9);
  EXPECT_EQ(qr.dependent().size(), expected.size()) << "another ordering finds as many, if not the same";
}

TEST(SparseQr, SolutionsAreThoseOfLeastSquaresWithoutDependentColumns) {
  const SparseMatrix A = band(60);
  const Eigen::MatrixXd b = right_sides(A.rows());
  SparseQr qr;
  for (const SparseQr::Ordering ordering : {SparseQr::Ordering::kNatural, SparseQr::Ordering::kFillReducing}) {
    qr.factor(A, 1e-9, ordering);
    const Eigen::MatrixXd x = qr.solve(b), shortest = least_norm(Eigen::MatrixXd(A)).solve(b);
    EXPECT_LT((A * (x - shortest)).cwiseAbs().maxCoeff(), 1e-12) << "the point of the columns' span nearest to b is one";
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

}  // namespace
}  // namespace codesign
