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

TEST(JointLaw, LeavesFreeWhatItsRowsDoNotHold) {
  for (const RowReference<JointLaw>& joint : joint_laws()) {
    const bool is_named = joint->of_joints || joint->of_loops;
    if (!is_named || joint->type == JointType::kDistance) continue;
    EXPECT_EQ(joint->rows + joint->freedoms.size(), 6) << static_cast<int>(joint->type);
  }
}

TEST(JointLaw, JointsOfTheTreeHaveCoordinatesInEveryPosition) {
  for (const RowReference<JointLaw>& joint : joint_laws()) {
    if (!joint->of_joints) continue;
    const JointFreedoms& freedoms = joint->freedoms;
    EXPECT_TRUE(freedoms.turns <= 1 || freedoms.turns == 3) << joint->of_joints;
    for (int k = 0; k < freedoms.size(); ++k)
      EXPECT_EQ(freedoms.each[static_cast<std::size_t>(k)].turns, k >= freedoms.slides)
          << joint->of_joints;
  }
}

TEST(JointLaw, InTheirPlaneLoopsHaveAsManyRowsAsTheyHaveFreedomsLess) {
  int found = 0;
  for (const RowReference<JointLaw>& joint : joint_laws()) {
    if (!joint->in_plane) continue;
    ++found;
    const PairKind kind(*joint->in_plane);
    const PairRows<double> rows = pair_rows(kind, PairConstants<double>());
    EXPECT_FALSE(rows.coincident);
    EXPECT_EQ(rows.size(), kind->rows);
    EXPECT_EQ(kind->rows, joint->rows - 3) << "three rows are out of the plane";
    EXPECT_LE(kind->force_rows(), kind->rows);
    EXPECT_EQ(kind->has_one_coordinate(), joint->has_one_coordinate());
    EXPECT_EQ(static_cast<bool>(kind->bearing.normal_force),
              static_cast<bool>(joint->bearing.normal_force));
  }
  EXPECT_EQ(found, 4);
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
