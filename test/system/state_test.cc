// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "system/state.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

/// Two bodies, a pair with five rows and one with three, a coupling, two extra states.
Layout layout() {
  Layout layout;
  layout.bodies = 2;
  layout.n = 14;
  layout.m = 11;
  layout.couplings = 1;
  layout.states = 2;
  layout.pair_row = {0, 5};
  return layout;
}

TEST(Layout, RowsFollowEachOther) {
  EXPECT_EQ(layout().columns(), 27);
  EXPECT_EQ(layout().positions(), 16);
  EXPECT_EQ(layout().pair_end(0), 5);
  EXPECT_EQ(layout().pair_end(1), 8);
  EXPECT_EQ(layout().coupling_row(0), 8);
  EXPECT_EQ(layout().norm_row(0), 9);
  EXPECT_EQ(layout().norm_row(1), 10);
  EXPECT_EQ(layout().lambda_column(layout().norm_row(1)) + 1, layout().state_column(0));
}

TEST(Layout, EveryPositionIsEliminatedByARate) {
  EXPECT_EQ(layout().rate_column(13), 13);
  EXPECT_EQ(layout().rate_column(layout().position_column(1)), layout().state_column(1));
}

TEST(State, HasZerosOfItsLayout) {
  State<double> state;
  state.resize(layout());
  EXPECT_EQ(state.q.size(), 14);
  EXPECT_EQ(state.v.size(), 14);
  EXPECT_EQ(state.s.size(), 2);
  EXPECT_EQ(state.z.size(), 27);
  EXPECT_EQ(state.z.norm(), 0.0);
}

}  // namespace
}  // namespace codesign
