// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "elements/link_elements.h"

#include <gtest/gtest.h>

#include "description/link_elements.h"
#include "mechanism/signal_catalog.h"

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
