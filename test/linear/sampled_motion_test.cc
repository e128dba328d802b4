// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sampled_motion.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using EventKind = ControlEvent::Kind;

MotionStudy sampled(const std::vector<std::pair<double, double>>& times) {
  MotionStudy study;
  for (const auto& [time, delay] : times) {
    ControllerDescription controller;
    controller.name = "c" + std::to_string(study.controllers.size());
    controller.realization.sample_time = time;
    controller.realization.delay = delay;
    study.controllers.push_back(controller);
  }
  return study;
}

TEST(SamplePattern, OfNothingSampled) {
  const SamplePattern pattern = sample_pattern(sampled({{0.0, 0.0}}));
  EXPECT_EQ(pattern.period, 0.0);
  EXPECT_EQ(pattern.samples, std::vector<int>{0});
}

TEST(SamplePattern, SeveralSampleTimesMeetAgain) {
  const SamplePattern pattern = sample_pattern(sampled({{0.02, 0.0}, {0.03, 0.0}, {0.0, 0.0}}));
  EXPECT_NEAR(pattern.period, 0.06, 1e-15);
  EXPECT_EQ(pattern.samples, (std::vector<int>{3, 2, 0}));
  ASSERT_EQ(pattern.instants.size(), 4U);
  EXPECT_EQ(pattern.instants[0].events.size(), 2U);
  EXPECT_NEAR(pattern.instants[2].time, 0.03, 1e-15);
  EXPECT_EQ(pattern.instants[2].events[0].controller, 1);
}

// The output of sample k - 2 comes into effect in the middle of the period of sample k.
TEST(SamplePattern, DelayedOutputsOfEarlierSamples) {
  const SamplePattern pattern = sample_pattern(sampled({{0.1, 0.25}}));
  ASSERT_EQ(pattern.instants.size(), 2U);
  EXPECT_EQ(pattern.instants[0].events[0].kind, EventKind::kSample);
  EXPECT_NEAR(pattern.instants[1].time, 0.05, 1e-12);
  EXPECT_EQ(pattern.instants[1].events[0].kind, EventKind::kApply);
  EXPECT_EQ(pattern.instants[1].events[0].sample, pattern.instants[0].events[0].sample - 2);
}

// At one instant the old output comes into effect before the new sample takes its place.
TEST(SamplePattern, ADelayOfWholeSamples) {
  const SamplePattern pattern = sample_pattern(sampled({{0.1, 0.3}}));
  ASSERT_EQ(pattern.instants.size(), 1U);
  ASSERT_EQ(pattern.instants[0].events.size(), 2U);
  EXPECT_EQ(pattern.instants[0].events[0].kind, EventKind::kApply);
  EXPECT_EQ(pattern.instants[0].events[0].sample, pattern.instants[0].events[1].sample - 3);
}

TEST(SamplePattern, RefusesTimesWithoutACommonPeriod) {
  try {
    sample_pattern(sampled({{0.1, 0.0}, {0.0314159265, 0.0}}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "controllers.c0.sample_time");
    EXPECT_NE(std::string(error.what()).find("no common period"), std::string::npos);
  }
}

}  // namespace
}  // namespace codesign
