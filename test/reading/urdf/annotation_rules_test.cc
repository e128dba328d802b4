// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace codesign {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(AnnotationRules, AreFoundByPath) {
  ASSERT_NE(find_rule("robot/joint/codesign:friction"), nullptr);
  EXPECT_TRUE(has(find_rule("robot/joint/codesign:friction")->twins, "mu_static"));
  EXPECT_TRUE(has(find_rule("robot/link/collision/geometry/cylinder")->twins, "radius"));
  EXPECT_EQ(find_rule("robot/gazebo"), nullptr);
  EXPECT_EQ(find_rule("joint"), nullptr);
}

TEST(AnnotationRules, EveryChildOfAStrictElementHasItsRule) {
  for (const char* path : {"robot/loop", "robot/coupling", "robot/codesign:spring_damper", "robot/loop/predecessor"}) {
    const ElementRule* rule = find_rule(path);
    ASSERT_NE(rule, nullptr) << path;
    EXPECT_TRUE(rule->strict) << path;
    for (const std::string& child : rule->children) EXPECT_NE(find_rule(path + ("/" + child)), nullptr) << path << "/" << child;
  }
}

TEST(AnnotationRules, ListsTheElementsOfOurOwn) {
  const std::vector<std::string> names = annotation_elements();
  EXPECT_EQ(names.size(), 8u);
  EXPECT_TRUE(has(names, "codesign:spring_damper") && has(names, "codesign:second_axis") && has(names, "codesign:length"));
}

}  // namespace
}  // namespace codesign
