// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/transposed_product.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

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
