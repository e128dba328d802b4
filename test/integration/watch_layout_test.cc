// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/watch_layout.h"
#include "description/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace codesign {
namespace {

TEST(WatchLayout, GivesEveryNumberAPlace) {
  Study study;
  study.duration = 2.0;
  WatchedSignal path, final;
  path.after = 0.5;
  path.before = 1.5;
  final.role = WatchedSignal::Role::kFinal;
  final.after = final.before = 2.0;
  study.watched = {path, final};
  const WatchLayout layout(study);
  const WatchLayout::Entry& first = layout.entries()[0];
  EXPECT_EQ(first.instants.front(), 0.5);
  EXPECT_EQ(first.instants.back(), 1.5);
  EXPECT_EQ(layout.entries()[1].instants, std::vector<double>{2.0});
  EXPECT_EQ(layout.entries()[1].windows(), 0);
  std::set<int> places{layout.entries()[1].at_instant(0)};
  for (int k = 0; k <= first.windows(); ++k) places.insert(first.at_instant(k));
  for (int k = 0; k < first.windows(); ++k) places.insert({first.largest(k), first.smallest(k)});
  EXPECT_EQ(static_cast<int>(places.size()), layout.size());
  EXPECT_EQ(*places.begin(), 0);
  EXPECT_EQ(*places.rbegin(), layout.size() - 1);
}

TEST(WatchLayout, BreakTimesAreInstants) {
  Study study;
  study.duration = 1.0;
  study.watched.emplace_back().before = 1.0;
  ControllerDescription& controller = study.controllers.emplace_back();
  controller.setpoint.kind = ReferenceDescription::Kind::kWaypoints;
  controller.setpoint.waypoints.times = {0.0, 0.33, 0.5, 1.0};
  const std::vector<double> instants = WatchLayout(study).entries()[0].instants;
  EXPECT_EQ(instants.size(), 18U) << "0.33 is new; 0.5 is the end of a window anyway";
  EXPECT_EQ(std::count(instants.begin(), instants.end(), 0.33), 1);
  EXPECT_TRUE(std::is_sorted(instants.begin(), instants.end()));
}

TEST(WatchLayout, ManyBreakTimesEndNoWindows) {
  Study study;
  study.duration = 1.0;
  study.watched.emplace_back().before = 1.0;
  ControllerDescription& controller = study.controllers.emplace_back();
  controller.setpoint.kind = ReferenceDescription::Kind::kWaypoints;
  for (int k = 0; k <= 500; ++k) controller.setpoint.waypoints.times.push_back(k / 500.0);
  const WatchLayout layout(study);
  EXPECT_EQ(layout.entries()[0].windows(), 16);
  EXPECT_EQ(layout.break_near(0.502, 1e-12), 251 / 500.0);
  EXPECT_TRUE(layout.break_near(1.0, 1e-12));
  EXPECT_TRUE(layout.break_near(0.5021, 1.1e-4));
  EXPECT_FALSE(layout.break_near(0.5021, 0.9e-4));
  EXPECT_FALSE(layout.break_near(1.1, 1e-3));
}

TEST(WatchLayout, PosturesHaveNoWindows) {
  Study study;
  study.postures = 5;
  study.duration = 4.0;
  WatchedSignal stroke;
  stroke.role = WatchedSignal::Role::kBounded;
  stroke.measure = WatchedSignal::Measure::kStroke;
  stroke.after = 0.5;
  stroke.before = 3.0;
  WatchedSignal final;
  final.role = WatchedSignal::Role::kFinal;
  final.after = final.before = 4.0;
  study.watched = {stroke, final};
  const WatchLayout layout(study);
  const WatchLayout::Entry& first = layout.entries()[0];
  EXPECT_EQ(first.instants, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(first.windows(), 0);
  EXPECT_EQ(first.measure(), 3);
  EXPECT_EQ(layout.entries()[1].first, 4);
  EXPECT_EQ(layout.entries()[1].instants, std::vector<double>{4.0});
  EXPECT_EQ(layout.size(), 5);
}

}  // namespace
}  // namespace codesign
