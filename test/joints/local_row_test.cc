// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/local_row.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(LocalRow, CoordinatesStandBodyByBody) {
  EXPECT_EQ(r_offset(Side::kI), 0);
  EXPECT_EQ(p_offset(Side::kI), 3);
  EXPECT_EQ(r_offset(Side::kJ), 7);
  EXPECT_EQ(p_offset(Side::kJ), 10);
  EXPECT_EQ(p_offset(Side::kJ) + 4, kLocalSize);
}

TEST(PairVector, ADirectionHasOneTermAndADisplacementTwo) {
  const auto direction = PairVector<double>::direction(Side::kJ, {1.0, 2.0, 3.0});
  ASSERT_EQ(direction.terms, 1);
  EXPECT_FALSE(direction.term[0].point);
  EXPECT_EQ(direction.term[0].side, Side::kJ);
  const auto d = PairVector<double>::displacement({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  ASSERT_EQ(d.terms, 2);
  for (const auto& term : d.term) {
    EXPECT_TRUE(term.point);
    EXPECT_EQ(term.sign, term.side == Side::kJ ? 1.0 : -1.0) << "from i to j";
    EXPECT_EQ(term.s, (term.side == Side::kJ ? Vector3<double>(0.0, 1.0, 0.0) : Vector3<double>(1.0, 0.0, 0.0)));
  }
}

}  // namespace
}  // namespace codesign
