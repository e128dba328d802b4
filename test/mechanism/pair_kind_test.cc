// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/pair_kind.h"

#include <gtest/gtest.h>

#include "joints/pair_rows.h"

namespace codesign {
namespace {

TEST(PairTraits, CountTheRowsThatPairsHave) {
  for (std::size_t k = 0; k < kPairTraits.size(); ++k) {
    const auto kind = static_cast<PairKind>(k);
    const PairRows<double> rows = pair_rows(kind, PairConstants<double>());
    EXPECT_EQ(rows.size(), traits_of(kind).rows) << k;
    EXPECT_EQ(rows.coincident, traits_of(kind).force == ForceRows::kAll) << k;
  }
  EXPECT_EQ(traits_of(PairKind::kFree).rows, 0) << "the last enumerator has the last row";
}

TEST(PairTraits, EveryJointTypeMakesAPairOfItsMotion) {
  for (const JointTypeName& name : kJointTypeNames) {
    const JointType expected = name.type == JointType::kContinuous ? JointType::kRevolute : name.type;
    EXPECT_EQ(traits_of(kind_of(name.type)).joint, expected);
  }
  EXPECT_EQ(kind_of(JointType::kPlanar), PairKind::kPlanar);
  EXPECT_EQ(kind_of(JointType::kFloating), PairKind::kFree);
}

TEST(PairTraits, IsotropicSlipHasACoordinatePerFreedomThatSlips) {
  for (PairKind kind : {PairKind::kTable, PairKind::kPlanar, PairKind::kSpherical}) {
    EXPECT_TRUE(slips_isotropically(kind));
    EXPECT_EQ(traits_of(kind).slip_coordinates, 6 - traits_of(kind).rows);
  }
  EXPECT_FALSE(slips_isotropically(PairKind::kRevolute));
}

}  // namespace
}  // namespace codesign
