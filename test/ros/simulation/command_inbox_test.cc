// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/command_inbox.h"

#include <gtest/gtest.h>
#include <ros/names.h>

namespace codesign {
namespace {

// commands_rostest.py and outside_loop_rostest.py have the tests that need a master.
TEST(CommandInbox, NamesBecomeLegalAndSlashesStay) {
  EXPECT_EQ(legal_name("hinge/position"), "hinge/position");
  EXPECT_EQ(legal_name("a/velocity - b-2/velocity"), "a/velocity___b_2/velocity");
  std::string why;
  EXPECT_TRUE(ros::names::validate("signals/" + legal_name("2 \xc3\xa4x/position"), why)) << why;
}

}  // namespace
}  // namespace codesign
