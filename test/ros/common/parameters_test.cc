// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/parameters.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using Names = std::vector<std::string>;

TEST(Parameters, ACommandLineGivesListsAsText) {
  EXPECT_EQ(names_in("elbow"), Names{"elbow"});
  const Names both{"elbow_servo", "wrist/1"};
  for (const char* text : {"elbow_servo,wrist/1", "[elbow_servo, wrist/1]",
                           "['elbow_servo','wrist/1']", " elbow_servo , wrist/1 "})
    EXPECT_EQ(names_in(text), both) << text;
  EXPECT_EQ(names_in("left elbow"), Names{"left elbow"});
  for (const char* text : {"", "[]", " , "}) EXPECT_EQ(names_in(text), Names()) << text;
}

TEST(Parameters, LaunchFilesPassNumbersAsTextToo) {
  double number = 0.0;
  for (const char* text : {"1e6", "1000000", "+1e6", "1.0E6"}) {
    EXPECT_TRUE(is_number(XmlRpc::XmlRpcValue(text), &number)) << text;
    EXPECT_EQ(number, 1e6) << text;
  }
  EXPECT_TRUE(is_number(XmlRpc::XmlRpcValue(3), &number));
  EXPECT_EQ(number, 3.0);
  for (const char* text : {"", "fast", "1e6 s", "0x10", "1,5", "true"})
    EXPECT_FALSE(is_number(XmlRpc::XmlRpcValue(text), &number)) << text;
  EXPECT_FALSE(is_number(XmlRpc::XmlRpcValue(true), &number));
}

TEST(Parameters, ACommandLineGivesADictionaryAsText) {
  XmlRpc::XmlRpcValue numbers = dictionary_in("{Kp: 80, crank_length: 0.07}");
  ASSERT_EQ(numbers.getType(), XmlRpc::XmlRpcValue::TypeStruct);
  EXPECT_EQ(numbers.size(), 2);
  EXPECT_EQ(static_cast<double>(numbers["Kp"]), 80.0);
  EXPECT_EQ(static_cast<double>(numbers["crank_length"]), 0.07);
  for (const char* text : {"", "Kp", "[1, 2]", "{Kp: much}", "{Kp: 80"})
    EXPECT_EQ(dictionary_in(text).getType(), XmlRpc::XmlRpcValue::TypeInvalid) << text;
}

}  // namespace
}  // namespace codesign
