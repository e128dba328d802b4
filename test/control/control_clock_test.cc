// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "control/control_clock.h"
#include "description/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace codesign {
namespace {

Study sampled_study(const std::vector<std::pair<double, double>>& controllers) {
  Study all;
  for (const auto& [period, delay] : controllers) {
    all.controllers.emplace_back();
    all.controllers.back().realization.sample_time = period;
    all.controllers.back().realization.delay = delay;
  }
  return all;
}

/// Events in a row: "s0:1" is sample 1 of controller 0, "a" an output that comes into effect.
std::string spell(const std::vector<ControlEvent>& events) {
  std::string text;
  for (const ControlEvent& event : events)
    text += std::string(text.empty() ? "" : " ") +
            (event.kind == ControlEvent::Kind::kSample ? "s" : "a") +
            std::to_string(event.controller) + ":" + std::to_string(event.sample);
  return text;
}

constexpr double kNever = std::numeric_limits<double>::infinity();

TEST(ControlClock, WithoutSampledControllersHasNoEvents) {
  ControlClock clock(sampled_study({{0.0, 0.0}}));
  EXPECT_TRUE(clock.is_empty());
  EXPECT_EQ(clock.next(3.0), 3.0);
  EXPECT_TRUE(clock.due(3.0).empty());
}

// A step that ends at k / rate may end one unit in the last place before the sample; the way
// between is no step.
TEST(ControlClock, LateInARunASampleIsReachedUpToRounding) {
  ControlClock clock(sampled_study({{1e-4, 0.0}}));
  for (int k = 1; k < 10240800; ++k) clock.due(1e-4 * k);
  const double instant = 1e-4 * 10240800, before = std::nextafter(instant, 0.0);
  EXPECT_GT(instant - before, 1e-9 * 1e-4);
  EXPECT_EQ(spell(clock.due(before)), "s0:10240800");
}

TEST(ControlClock, CountsInMultiplesOfThePeriod) {
  ControlClock clock(sampled_study({{0.1, 0.0}}));
  EXPECT_TRUE(clock.due(0.0).empty()) << "the sample at t = 0 belongs to the start";
  for (int k = 1; k <= 1000; ++k) {
    EXPECT_EQ(clock.next(kNever), 0.1 * k);
    EXPECT_EQ(spell(clock.due(0.1 * k)), "s0:" + std::to_string(k));
  }
  clock.start();
  EXPECT_EQ(clock.next(kNever), 0.1);
}

TEST(ControlClock, DelaysOutputsAndAppliesThemBeforeSamples) {
  ControlClock clock(sampled_study({{0.0, 0.0}, {0.1, 0.25}, {0.05, 0.05}}));
  EXPECT_EQ(clock.next(0.01), 0.01);
  EXPECT_EQ(spell(clock.due(0.05)), "a2:0 s2:1")
      << "a delay of one period: the output of the sample before";
  EXPECT_EQ(spell(clock.due(0.1)), "a2:1 s1:1 s2:2");
  EXPECT_EQ(spell(clock.due(0.15)), "a2:2 s2:3");
  EXPECT_EQ(spell(clock.due(0.2)), "a2:3 s1:2 s2:4");
  EXPECT_EQ(clock.next(kNever), 0.25);
  EXPECT_EQ(spell(clock.due(0.25 - 1e-13)), "a1:0 a2:4 s2:5")
      << "rounding of the time counts as reached, and once";
  EXPECT_NEAR(clock.next(kNever), 0.3, 1e-15);
}

TEST(ControlClock, QueuesAsManyOutputsAsWait) {
  EXPECT_EQ(sampled_study({{0.1, 0.0}}).controllers[0].realization.queued(), 0);
  EXPECT_EQ(sampled_study({{0.1, 0.03}}).controllers[0].realization.queued(), 1);
  EXPECT_EQ(sampled_study({{0.1, 0.1}}).controllers[0].realization.queued(), 1);
  EXPECT_EQ(sampled_study({{0.1, 0.3}}).controllers[0].realization.queued(), 3)
      << "0.3/0.1 is above 3 by rounding";
  EXPECT_EQ(sampled_study({{0.1, 0.31}}).controllers[0].realization.queued(), 4);
  EXPECT_EQ(sampled_study({{0.0, 0.0}}).controllers[0].realization.queued(), 0);
}

}  // namespace
}  // namespace codesign
