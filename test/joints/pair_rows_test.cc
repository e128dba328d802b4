// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/pair_rows.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

int rows_of(PairKind kind) { return pair_rows<double>(kind, PairConstants<double>()).size(); }

TEST(PairRows, EveryKindLeavesItsFreedoms) {
  EXPECT_EQ(rows_of(PairKind::kFixed), 6);
  EXPECT_EQ(rows_of(PairKind::kRevolute), 5);
  EXPECT_EQ(rows_of(PairKind::kPrismatic), 5);
  EXPECT_EQ(rows_of(PairKind::kCylindrical), 4);
  EXPECT_EQ(rows_of(PairKind::kUniversal), 4);
  EXPECT_EQ(rows_of(PairKind::kTable), 4);
  EXPECT_EQ(rows_of(PairKind::kSpherical), 3);
  EXPECT_EQ(rows_of(PairKind::kPlanar), 3);
  EXPECT_EQ(rows_of(PairKind::kTranslational), 3);
  EXPECT_EQ(rows_of(PairKind::kDistance), 1);
  EXPECT_EQ(rows_of(PairKind::kFree), 0);
}

TEST(PairRows, OnlyPointsOfDisplacementsAndAxesInUseAreMarked) {
  using Rows = PairRows<double>;
  const Rows hinge = pair_rows<double>(PairKind::kRevolute, PairConstants<double>());
  EXPECT_TRUE(hinge.coincident);
  const auto used = [&hinge](Side side, int k) { return hinge.used[static_cast<std::size_t>(Rows::shared(side, k))]; };
  EXPECT_TRUE(used(Side::kI, 0));
  EXPECT_TRUE(used(Side::kI, 1));
  EXPECT_TRUE(used(Side::kJ, 2));
  EXPECT_FALSE(used(Side::kI, Rows::kPoint));
  EXPECT_FALSE(used(Side::kJ, 0));
}

TEST(PairRows, ADistanceIsHalfASquare) {
  PairConstants<double> c;
  c.distance = 0.3;
  const auto rows = pair_rows<double>(PairKind::kDistance, c);
  EXPECT_DOUBLE_EQ(rows.products.front().offset, 0.09);
  EXPECT_DOUBLE_EQ(rows.products.front().scale, 0.5);
}

}  // namespace
}  // namespace codesign
