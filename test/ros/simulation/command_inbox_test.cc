// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulation/command_inbox.h"

#include <gtest/gtest.h>
#include <ros/names.h>

namespace codesign {
namespace {

// commands_rostest.py and outside_loop_rostest.py have the tests that need a master.
TEST(CommandInbox, NamesBecomeLegalAndSlashesStay) {
  std::set<std::string> taken;
  EXPECT_EQ(legal_name("hinge/position", &taken), "hinge/position");
  EXPECT_EQ(legal_name("a/velocity - b-2/velocity", &taken), "a/velocity___b_2/velocity");
  std::string why;
  EXPECT_TRUE(ros::names::validate("signals/" + legal_name("2 \xc3\xa4x/position", &taken), why))
      << why;
}

TEST(CommandInbox, EachSetPointHasALegalTopicOfItsOwn) {
  const std::vector<std::string> topics =
      setpoint_topics({"a b", "1c", "a_b", "_servo", "\xc3\xa9lan", "arm/servo", "~x", "a-b"});
  EXPECT_EQ(topics, (std::vector<std::string>{"a_b/command", "controller_1c/command",
                                              "a_b_2/command", "controller__servo/command",
                                              "controller___lan/command", "arm/servo/command",
                                              "controller__x/command", "a_b_3/command"}));
  std::string why;
  for (const std::string& topic : topics) EXPECT_TRUE(ros::names::validate(topic, why)) << why;
}

}  // namespace
}  // namespace codesign
