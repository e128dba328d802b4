// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sparse/pivots.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace codesign {
namespace {

// The pattern of an arrow matrix, full first row, first column and diagonal, in compressed-column
// form.
const std::vector<int> kPivotStart{0, 4, 6, 8, 10}, kPivotRows{0, 1, 2, 3, 0, 1, 0, 2, 0, 3};
const std::vector<double> kPivotValues{8.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};

TEST(Pivots, EliminationFillsTheMatrix) {
  const Pivots natural{{0, 1, 2, 3}, {0, 1, 2, 3}, {1.0, 1.0, 1.0, 1.0}};
  const LuPattern full = eliminate_pattern(natural, kPivotStart, kPivotRows);
  EXPECT_EQ(full.L, (std::vector<std::vector<int>>{{1, 2, 3}, {2, 3}, {3}, {}}));
  EXPECT_EQ(full.U, (std::vector<std::vector<int>>{{}, {0}, {0, 1}, {0, 1, 2}}));
  EXPECT_EQ(count_products(full), 9 + 4 + 1);

  const Pivots reversed{{3, 2, 1, 0}, {3, 2, 1, 0}, {1.0, 1.0, 1.0, 1.0}};
  const LuPattern sparse = eliminate_pattern(reversed, kPivotStart, kPivotRows);
  EXPECT_EQ(sparse.L, (std::vector<std::vector<int>>{{3}, {3}, {3}, {}}));
  EXPECT_EQ(count_products(sparse), 3);
}

TEST(Pivots, TheCheapestProposalIsTaken) {
  const auto chosen = choose_pivots(kPivotStart, kPivotRows, kPivotValues);
  ASSERT_TRUE(chosen);
  EXPECT_EQ(count_products(*chosen), 3);
}

TEST(Pivots, ThereAreNoneForASingularMatrix) {
  std::vector<double> values = kPivotValues;
  // The last two rows become multiples of the first unit vector.
  values[7] = values[9] = 0.0;
  EXPECT_FALSE(choose_pivots(kPivotStart, kPivotRows, values));
}

}  // namespace
}  // namespace codesign
