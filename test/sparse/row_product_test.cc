// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/row_product.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

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

}  // namespace
}  // namespace codesign
