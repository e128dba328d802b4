// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism_codesign/model/nearest_name.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(NearestName, FindsInsertedDroppedReplacedAndSwappedLetters) {
  const std::vector<std::string> known = {"duration", "crank_length", "rod_length"};
  EXPECT_EQ(nearest_name("duratiion", known), "duration");
  EXPECT_EQ(nearest_name("duraton", known), "duration");
  EXPECT_EQ(nearest_name("duretion", known), "duration");
  EXPECT_EQ(nearest_name("crank_lenght", known), "crank_length");
  EXPECT_EQ(nearest_name("Crank_Length", known), "crank_length");
}

TEST(NearestName, TakesTheNearestOfSeveral) {
  EXPECT_EQ(nearest_name("joint_2x", {"joint_1", "joint_2", "joint_3"}), "joint_2");
  EXPECT_EQ(nearest_name("ba", {"bac", "ab", "ba_"}), "bac");
}

TEST(NearestName, GivesNothingWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("banana", {"duration", "objective"}), "");
  EXPECT_EQ(nearest_name("x", {"y", "z"}), "");
  EXPECT_EQ(nearest_name("anything", {}), "");
}

}  // namespace
}  // namespace codesign
