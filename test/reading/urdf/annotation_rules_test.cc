// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "reading/page_rows.h"

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
  for (const char* path :
       {"robot/loop", "robot/coupling", "robot/codesign:spring_damper", "robot/loop/predecessor"}) {
    const ElementRule* rule = find_rule(path);
    ASSERT_NE(rule, nullptr) << path;
    EXPECT_TRUE(rule->strict) << path;
    for (const std::string& child : rule->children)
      EXPECT_NE(find_rule(path + ("/" + child)), nullptr) << path << "/" << child;
  }
}

TEST(AnnotationRules, HaveTheTwinsOfThePage) {
  const std::string link = "robot/link/", joint = "robot/joint/", loop = "robot/loop/";
  std::map<std::string, std::string> paths = {{"<origin>", joint + "origin"},
                                              {"<mass>", link + "inertial/mass"}};
  paths["<inertia>"] = link + "inertial/inertia";
  for (const char* shape : {"box", "cylinder", "sphere"})
    paths["<" + std::string(shape) + ">"] = link + "visual/geometry/" + shape;
  for (const char* tag : {"axis", "dynamics", "codesign:actuator", "mimic", "limit"})
    paths["<" + std::string(tag) + ">"] = joint + tag;
  for (const char* tag : {"codesign:second_axis", "codesign:length"})
    paths["<" + std::string(tag) + ">"] = loop + tag;
  paths["<ratio>"] = "robot/coupling/ratio";
  for (const PageRow& row : page_rows("annotations.md", 1)) {
    const std::vector<std::string> parts = split_at(row.cells[0], "; ");
    for (std::size_t k = 0; k < row.keys.size(); ++k) {
      const auto path = paths.find(row.keys[k]);
      if (path == paths.end()) continue;
      EXPECT_EQ(find_rule(path->second)->twins,
                quoted_in(parts.size() == row.keys.size() ? parts[k] : row.cells[0]))
          << path->first;
      paths.erase(path);
    }
  }
  EXPECT_TRUE(paths.empty()) << paths.begin()->first;
}

TEST(AnnotationRules, ListsTheElementsOfOurOwn) {
  const std::vector<std::string> names = annotation_elements();
  EXPECT_EQ(names.size(), 10u);
  EXPECT_TRUE(has(names, "codesign:spring_damper") && has(names, "codesign:second_axis") &&
              has(names, "codesign:length") && has(names, "codesign:contact") &&
              has(names, "codesign:clearance"));
}

}  // namespace
}  // namespace codesign
