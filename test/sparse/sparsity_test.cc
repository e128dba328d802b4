// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "sparse/sparsity.h"

namespace codesign {
namespace {

TEST(Sparsity, ALinearizationHasAValuePerNonzero) {
  const Sparsity one{2, 3, {0, 1, 2}, {0, 2}}, none{2, 3, {0, 0, 0}, {}};
  Linearization<double> values;
  values.resize({one, none, one});
  EXPECT_EQ(values.position.size(), 2U);
  EXPECT_EQ(values.velocity.size(), 0U);
  EXPECT_EQ(values.time.size(), 2);
  EXPECT_EQ(one.first(1), 1);
  EXPECT_EQ(one.column(1), 2);
}

TEST(Sparsity, AClearedGradientIsEmpty) {
  SparseGradient<double> gradient;
  gradient.position.push_back({1, 2.0});
  gradient.rate.push_back({2, 3.0});
  gradient.time = 1.0;
  gradient.clear();
  EXPECT_TRUE(gradient.position.empty());
  EXPECT_TRUE(gradient.rate.empty());
  EXPECT_EQ(gradient.time, 0.0);
}

// One row (3, 0, 5).
const Sparsity kProductPattern{1, 3, {0, 2}, {0, 2}};
const std::vector<double> kProductValues{3.0, 5.0};

TEST(RowProduct, OfOneVector) {
  const double x[] = {1.0, 100.0, 2.0};
  EXPECT_EQ(row_product(kProductPattern, kProductValues, 0, x), 13.0);
}

TEST(RowProduct, OfSeveralVectorsAndOfTangents) {
  double x[12];
  for (int k = 0; k < 12; ++k) x[k] = k;
  Lanes<4>::Vector sum{};
  add_row_product<4>(kProductPattern, kProductValues, 0, x, &sum);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(sum[k], 3.0 * k + 5.0 * (8 + k));

  std::vector<double> derivatives(8, 0.0);
  derivatives[6] = 7.0;
  const double u[] = {1.0, 100.0, 2.0, 0.0, 0.0, 0.0, 0.0};
  const In<double> both[] = {u, x};
  Lanes<4>::Vector tangents[2] = {};
  add_row_tangents<4>(kProductPattern, derivatives, 0, both, 0, tangents);
  EXPECT_EQ(tangents[0][2], 14.0);
  EXPECT_EQ(tangents[0][0], 0.0);
  EXPECT_EQ(tangents[1][2], 14.0);
  add_row_tangents<4>(kProductPattern, derivatives, 0, both, 4, tangents);
  EXPECT_EQ(tangents[1][2], 14.0 + 42.0);
}

// A = [1 . 2; . 3 .; 4 5 .]
TEST(TransposedProduct, AddsTheRowsAskedFor) {
  const Sparsity pattern{3, 3, {0, 2, 3, 5}, {0, 2, 1, 0, 1}};
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0}, y = {1.0, 10.0, 100.0};
  std::vector<double> x = {0.5, 0.0, 0.0};
  add_transposed_product(pattern, values, {0, 3}, 2.0, y, x);
  EXPECT_EQ(x, (std::vector<double>{802.5, 1060.0, 4.0}));
  x.assign(3, 0.0);
  add_transposed_product(pattern, values, {1, 2}, 1.0, y, x);
  EXPECT_EQ(x, (std::vector<double>{0.0, 30.0, 0.0}));
}

}  // namespace

}  // namespace codesign
