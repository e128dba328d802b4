// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/friction.h"

#include <gtest/gtest.h>

#include <set>

namespace codesign {
namespace {

TEST(FrictionNumbers, EveryMemberIsVisitedOnce) {
  FrictionNumbers<double> numbers;
  std::set<const double*> visited;
  std::set<std::string> names;
  const auto note = [&](const FrictionNumberRule& rule, double& number) {
    visited.insert(&number);
    names.insert(rule.attribute);
  };
  visit_friction_numbers(note, &numbers);
  EXPECT_EQ(visited.size(), sizeof(numbers) / sizeof(double));
  EXPECT_EQ(names.size(), visited.size());
}

TEST(FrictionNumbers, TwoStructuresAreVisitedSideBySide) {
  FrictionNumbers<double> from;
  FrictionNumbers<float> to;
  from.preload = 3.0;
  visit_friction_numbers([](const FrictionNumberRule&, const double& a, float& b) { b = static_cast<float>(a); }, &from, &to);
  EXPECT_EQ(to.preload, 3.0F);
}

TEST(FrictionNumbers, ModelsUseTheirOwn) {
  std::set<std::string> of_lugre, of_gonthier;
  const auto note = [&](const FrictionNumberRule& rule, const Quantity&) {
    if (FrictionModel::kLuGre->uses(rule)) of_lugre.insert(rule.attribute);
    if (FrictionModel::kGonthier->uses(rule)) of_gonthier.insert(rule.attribute);
    EXPECT_EQ(FrictionModel::kBrownMcPhee->uses(rule),
              rule.laws == FrictionNumberRule::Laws::kAll || rule.laws == FrictionNumberRule::Laws::kDirectional);
  };
  const FrictionDescription friction;
  visit_friction_numbers(note, &friction);
  EXPECT_EQ(of_gonthier.size(), of_lugre.size() + 1);
  EXPECT_EQ(of_lugre.count("dwell_time"), 0U);
  EXPECT_EQ(of_lugre.count("mu_static_backward"), 0U);
  EXPECT_EQ(of_lugre.count("viscous_backward"), 1U);
  EXPECT_EQ(friction.dwell_time.nominal(), 2.0);
}

}  // namespace
}  // namespace codesign
