// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint_law.h"

#include <gtest/gtest.h>

#include "joints/pair_constants.h"
#include "joints/pair_rows.h"

namespace codesign {
namespace {

TEST(JointLaw, CountsTheRowsThatPairsHave) {
  for (const RowReference<JointLaw>& joint : joint_laws()) {
    const PairRows<double> rows = pair_rows(PairKind(*joint), PairConstants<double>());
    EXPECT_EQ(rows.size(), joint->rows) << static_cast<int>(joint->type);
    EXPECT_EQ(rows.coincident, joint->force_rows() == 3) << static_cast<int>(joint->type);
    EXPECT_LE(joint->force_rows(), joint->rows) << static_cast<int>(joint->type);
  }
}

TEST(JointLaw, AContinuousJointMakesARevolutePair) {
  for (const RowReference<JointLaw>& joint : joint_laws())
    EXPECT_EQ(pair_of(*joint),
              joint->type == JointType::kContinuous ? PairKind::kRevolute : PairKind(*joint))
        << static_cast<int>(joint->type);
}

TEST(JointLaw, IsotropicSlipHasACoordinatePerFreedomThatSlips) {
  for (PairKind kind : {PairKind::kTable, PairKind::kPlanar, PairKind::kSpherical}) {
    EXPECT_TRUE(slips_isotropically(kind));
    EXPECT_EQ(kind->slip_coordinates, 6 - kind->rows);
    EXPECT_EQ(kind->is_plane(), kind != PairKind::kSpherical);
  }
  EXPECT_FALSE(slips_isotropically(PairKind::kRevolute));
}

}  // namespace
}  // namespace codesign
