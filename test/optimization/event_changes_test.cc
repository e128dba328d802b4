// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/event_changes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ensemble/other_steps_fixture.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

const Eigen::Vector2d kBest(1.0, 2.0), kRanges(1.0, 10.0);

Warnings warnings_beside(const Eigen::Vector2d& rho, const Events& other, const Events& of_best) {
  EventChanges changes;
  changes.note(kBest, of_best);
  changes.note(rho, other);
  return changes.warnings(kBest, of_best, kRanges, "study.yaml");
}

TEST(EventChanges, WarnsOfOtherEventsOrAnotherOrderBesideTheBestPoint) {
  const Events one{{}, 1, "a"}, two{{}, 2, "b"}, turned{{}, 2, "c"};
  const Eigen::Vector2d near(1.0, 2.009), far(1.0, 2.011);
  EXPECT_TRUE(warnings_beside(near, one, one).empty());
  EXPECT_TRUE(warnings_beside(far, one, two).empty()) << "more than a thousandth of the range";
  const Warnings number = warnings_beside(near, one, two),
                 order = warnings_beside(near, turned, two);
  ASSERT_EQ(number.size(), 1u);
  EXPECT_EQ(number[0].code, "events_changed");
  EXPECT_NE(number[0].message.find("1 events in place of 2"), std::string::npos)
      << number[0].message;
  ASSERT_EQ(order.size(), 1u);
  EXPECT_NE(order[0].message.find("2 events in another order"), std::string::npos)
      << order[0].message;
}

TEST(EventChanges, OnlyTheLastPointsCount) {
  EventChanges changes;
  changes.note(kBest, {{}, 1, "a"});
  for (int k = 0; k < 500; ++k) changes.note(kBest, {{}, 2, "b"});
  EXPECT_TRUE(changes.warnings(kBest, {{}, 2, "b"}, kRanges, "study.yaml").empty());
}

std::vector<std::string> codes_of_search(const std::string& load, const std::string& reference) {
  const OptimizationResult result =
      optimize(slide("duration: 2.0\nloads: [{joint: x, effort: \"" + load +
                     "\"}]\nparameters: {ts: {initial: 0.5, lower: 0.1, upper: 1.9}}\n"
                     "objective: {terminal: [{signal: x/velocity, reference: " +
                     reference + "}]}\n"));
  EXPECT_TRUE(result.status.ok()) << describe(result.status);
  std::vector<std::string> codes;
  for (const Warning& warning : result.warnings) codes.push_back(warning.code);
  return codes;
}

// v(2) = ts up to ts = 1 and 3 - 2 ts beyond it: the search for v = 2 stops at the kink ts = 1,
// where both switches happen at once.
TEST(EventChanges, ASearchThatStopsAtAKinkIsTold) {
  const auto codes = codes_of_search("${(t < ts ? 1 : 0)*(t < 1 ? 1 : -2)}", "2.0");
  EXPECT_EQ(std::count(codes.begin(), codes.end(), "events_changed"), 1);
}

// The same switches, with the optimum v = 0.7 away from the kink.
TEST(EventChanges, ASearchThatStopsElsewhereIsNot) {
  const auto codes = codes_of_search("${(t < ts ? 1 : 0)*(t < 1 ? 1 : -2)}", "0.7");
  EXPECT_EQ(std::count(codes.begin(), codes.end(), "events_changed"), 0);
}

}  // namespace
}  // namespace codesign
