// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/apply/server_hold.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using HoldNodes = std::vector<std::string>;

TEST(ServerHold, TheFirstOnTheListHolds) {
  const HoldNodes nodes = {"/b", "/a", "/c"};
  EXPECT_EQ(nodes_before("/b", nodes), HoldNodes());
  EXPECT_EQ(nodes_before("/a", nodes), HoldNodes({"/b"}));
  EXPECT_EQ(nodes_before("/c", nodes), HoldNodes({"/b", "/a"}));
  EXPECT_EQ(nodes_before("/d", nodes), nodes) << "the master does not know it yet";
}

TEST(ServerHold, TheSentenceNamesTheHolderAndHowLong) {
  const HoldNote note{2.14, "ramp 6 s, hold 1 s"};
  EXPECT_EQ(held_sentence("/simulation", "/codesign_apply_7", &note),
            "/codesign_apply_7 changes the values of /simulation, for 2.1 s by now (ramp 6 s, hold "
            "1 s); wait for its end, or end it: rosnode kill /codesign_apply_7");
  EXPECT_EQ(held_sentence("/simulation", "/other", nullptr),
            "/other changes the values of /simulation; wait for its end, or end it by a message on "
            "its topic apply/cancel");
}

}  // namespace
}  // namespace codesign
