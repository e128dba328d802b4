// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using Names = std::vector<std::string>;

TEST(Parameters, ACommandLineGivesListsAsText) {
  EXPECT_EQ(names_in("elbow"), Names{"elbow"});
  const Names both{"elbow_servo", "wrist/1"};
  for (const char* text : {"elbow_servo,wrist/1", "[elbow_servo, wrist/1]", "['elbow_servo','wrist/1']", " elbow_servo , wrist/1 "})
    EXPECT_EQ(names_in(text), both) << text;
  EXPECT_EQ(names_in("left elbow"), Names{"left elbow"});
  for (const char* text : {"", "[]", " , "}) EXPECT_EQ(names_in(text), Names()) << text;
}

}  // namespace
}  // namespace codesign
