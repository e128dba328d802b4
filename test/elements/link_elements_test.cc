// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "elements/link_elements.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "description/robot.h"
#include "mechanism/signal_catalog.h"
#include "paths.h"

namespace codesign {
namespace {

TEST(LinkElements, HaveValuesOfEachKind) {
  int kinds = 0, values = 0;
  const RobotDescription robot;
  for_each_link_element_kind(robot, [&](const LinkElementKind&, const auto&) { ++kinds; });
  for_each_link_element_values([&](const auto&) { ++values; });
  EXPECT_EQ(kinds, values);
  EXPECT_EQ(link_element_tags(),
            (std::vector<std::string>{"codesign:spring_damper", "codesign:contact"}));
}

/// Files of src/, without those that are of spring-dampers alone, that name them.
std::set<std::string> files_that_name_spring_dampers() {
  const auto names_them = [](const std::string& text) {
    for (const char* name :
         {"SpringDamper", "spring_damper", "SpringForce", "kSpring,", "spring_at"})
      if (text.find(name) != std::string::npos) return true;
    return false;
  };
  const std::set<std::string> own{"forces/compliance.h", "elements/spring_damper.h",
                                  "mechanism/spring_constants.h", "mechanism/spring_constants.cc",
                                  "reading/urdf/spring_reader.cc"};
  const std::filesystem::path root = std::filesystem::path(source_dir()) / "src";
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::string name = entry.path().lexically_relative(root).string();
    if (own.count(name) == 0 && names_them(text)) found.insert(name);
  }
  return found;
}

// What a new kind touches beside files of its own, doc/architecture.md.
TEST(LinkElements, AKindStandsInFivePlaces) {
  EXPECT_EQ(files_that_name_spring_dampers(),
            (std::set<std::string>{"description/robot.h", "description/signal_table.h",
                                   "elements/link_elements.h", "mechanism/constants.h",
                                   "reading/urdf/joint_reader.h"}));
}

TEST(LinkElements, HaveThePowersThatTheyLose) {
  EXPECT_TRUE(SpringDampers::has_power(PowerKind::kDamping));
  EXPECT_FALSE(SpringDampers::has_power(PowerKind::kFriction));
  EXPECT_TRUE(BodyContacts::has_power(PowerKind::kFriction));
  EXPECT_FALSE(BodyContacts::has_power(PowerKind::kActuator));
}

TEST(LinkElements, AreFoundByNameAndQuantity) {
  RobotDescription robot;
  robot.spring_dampers.resize(2);
  robot.spring_dampers[1].name = "strut";
  robot.contacts.resize(3);
  robot.contacts[2].name = "sole";
  const auto find = [&](const char* object, const char* quantity) {
    return find_link_element({1.0, object, quantity, ""}, robot);
  };
  const auto strut = find("strut", "length"), sole = find("sole", "gap");
  ASSERT_TRUE(strut && sole);
  EXPECT_EQ(strut->kind, SignalOwner::kSpring);
  EXPECT_EQ(strut->index, 1);
  EXPECT_EQ(sole->kind, SignalOwner::kContact);
  EXPECT_EQ(sole->index, 2);
  EXPECT_FALSE(find("strut", "gap"));
  EXPECT_FALSE(find("sole", "length"));
  EXPECT_FALSE(find("other", "gap"));
}

}  // namespace
}  // namespace codesign
