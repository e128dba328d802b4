// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/signal_table.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "paths.h"

namespace codesign {
namespace {

TEST(SignalTable, EveryQuantityHasALineInThePage) {
  std::ifstream file(source_dir() + "/doc/study/signals.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  const std::string list = page.substr(0, page.find("## Functions of time"));
  for (const SignalFacts& facts : signal_table::kFacts) {
    const std::string spelling = "/" + std::string(facts.quantity);
    EXPECT_NE(list.find(spelling), std::string::npos) << facts.quantity;
  }
}

TEST(SignalTable, AnOwnerHasANameOnce) {
  std::set<std::pair<SignalOwner, std::string>> names;
  for (const SignalFacts& facts : signal_table::kFacts) {
    if (*facts.quantity == '\0') continue;
    EXPECT_TRUE(names.emplace(facts.owner, facts.quantity).second) << facts.quantity;
  }
}

TEST(SignalTable, NamesAreFoundByOwner) {
  ASSERT_NE(find_quantity(SignalOwner::kLink, "velocity"), nullptr);
  EXPECT_EQ(find_quantity(SignalOwner::kLink, "velocity")->kind, SignalKind::kLinkVelocity);
  EXPECT_EQ(find_quantity(SignalOwner::kJoint, "velocity")->rate, SignalKind::kJointAcceleration);
  EXPECT_EQ(find_quantity(SignalOwner::kSpring, "velocity"), nullptr);
  EXPECT_TRUE(is_quantity("total_energy"));
  EXPECT_FALSE(is_quantity("energy"));
  EXPECT_FALSE(is_quantity(""));  // derivatives have no name
}

/// A rate is of the same owner and has the same components as what it is the rate of.
TEST(SignalTable, RatesFitTheirQuantities) {
  for (const SignalFacts& facts : signal_table::kFacts) {
    if (facts.rate == SignalKind::kNone) continue;
    EXPECT_EQ(facts_of(facts.rate).owner, facts.owner) << facts.quantity;
    EXPECT_EQ(facts_of(facts.rate).shape, facts.shape) << facts.quantity;
  }
}

}  // namespace
}  // namespace codesign
