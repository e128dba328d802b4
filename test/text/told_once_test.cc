// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "text/told_once.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace codesign {
namespace {

std::vector<std::string> told_messages(const Warnings& warnings) {
  std::vector<std::string> messages;
  for (const Warning& warning : told_once(warnings)) messages.push_back(warning.message);
  return messages;
}

Warning of_limit(const char* file, int line, const char* joint, const char* value) {
  return warn("limit_ignored", {{file, line},
                                "<joint name=\"" + std::string(joint) + "\"> <limit>",
                                "it is ignored",
                                value,
                                ""});
}

TEST(ToldOnce, OneOfEachKindInEachFile) {
  EXPECT_EQ(told_messages({of_limit("a", 3, "x", "1"), of_limit("a", 5, "y", "2"),
                           of_limit("b", 7, "z", "3"), of_limit("a", 9, "u", "4")}),
            std::vector<std::string>(
                {"a:3: <joint name=\"x\"> <limit>: it is ignored (value: 1); the same at 2 further "
                 "places of this file, the last in line 9",
                 "b:7: <joint name=\"z\"> <limit>: it is ignored (value: 3)"}));
  EXPECT_EQ(
      told_messages({of_limit("a", 3, "x", "1"), of_limit("a", 5, "y", "2")}).front(),
      "a:3: <joint name=\"x\"> <limit>: it is ignored (value: 1); the same at 1 further place "
      "of this file, the last in line 5");
}

TEST(ToldOnce, OtherElementsCodesAndSentencesAreOfOtherKinds) {
  const Warnings different = {
      of_limit("a", 3, "x", "1"),
      warn("limit_ignored", {{"a", 4}, "<joint name=\"x\">", "it is ignored", "", ""}),
      warn("limit_ignored", {{"a", 5}, "<joint name=\"x\"> <limit>", "it is wrong", "", ""}),
      warn("limits", {{"a", 6}, "<joint name=\"x\"> <limit>", "it is ignored", "1", ""}),
      {"bare", "x", {}},
      {"bare", "x", {}}};
  EXPECT_EQ(told_messages(different).size(), different.size());
}

}  // namespace
}  // namespace codesign
