// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/sparsity.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace codesign
