// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/band_stays.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using Eigen::Vector2d;

/// The band [1, 3] in the interval from 0 to 10 s, with two parameters.
BandStays stays(WatchedSignal::Measure measure) {
  WatchedSignal watched;
  watched.measure = measure;
  watched.band_lower = Quantity(1.0);
  watched.band_upper = Quantity(3.0);
  watched.before = 10.0;
  BandStays band;
  band.start(MotionStudy(), watched, {}, 2);
  return band;
}

Differentiated number(double value, double by_first, double by_second) {
  return {value, Vector2d(by_first, by_second)};
}

const Differentiated kUnused = number(0.0, 0.0, 0.0);

TEST(BandStays, AddUpToTheDwell) {
  BandStays band = stays(WatchedSignal::Measure::kDwell);
  band.begin(0.0, 0.5);
  band.cross(2.0, Vector2d(0.1, 0.2), true);
  band.cross(3.0, Vector2d(0.4, 0.3), false);
  band.cross(7.0, Vector2d(1.0, 0.0), true);
  const Differentiated dwell = band.end(10.0, number(2.0, 9.0, 9.0), kUnused, kUnused);
  EXPECT_DOUBLE_EQ(dwell.value, 4.0);
  EXPECT_TRUE(dwell.gradient.isApprox(Vector2d(0.4 - 0.1 - 1.0, 0.3 - 0.2)));
}

TEST(BandStays, TheLastOneBeginsAtTheArrival) {
  BandStays band = stays(WatchedSignal::Measure::kArrival);
  band.begin(0.0, 2.0);
  band.cross(2.0, Vector2d(0.1, 0.2), false);
  band.cross(7.0, Vector2d(1.0, -1.0), true);
  const Differentiated arrival = band.end(10.0, number(2.0, 9.0, 9.0), kUnused, kUnused);
  EXPECT_EQ(arrival.value, 7.0);
  EXPECT_EQ(arrival.gradient, Eigen::VectorXd(Vector2d(1.0, -1.0)));
}

TEST(BandStays, ASignalThatNeverLeavesArrivesAtTheBegin) {
  BandStays band = stays(WatchedSignal::Measure::kArrival);
  band.begin(0.5, 2.0);
  const Differentiated arrival = band.end(10.0, number(2.0, 9.0, 9.0), kUnused, kUnused);
  EXPECT_EQ(arrival.value, 0.5);
  EXPECT_EQ(arrival.gradient, Eigen::VectorXd(Vector2d(0.0, 0.0)));
}

TEST(BandStays, AreMissedByTheDistanceInUnitsOfTheBand) {
  BandStays late = stays(WatchedSignal::Measure::kArrival);
  late.begin(0.0, 4.0);
  const Differentiated arrival = late.end(10.0, number(3.5, 0.2, -0.4), kUnused, kUnused);
  EXPECT_DOUBLE_EQ(arrival.value, 10.0 + 10.0 * 0.5 / 2.0);
  EXPECT_TRUE(arrival.gradient.isApprox(Vector2d(1.0, -2.0)));
  BandStays below = stays(WatchedSignal::Measure::kDwell);
  below.begin(0.0, 0.0);
  const Differentiated dwell =
      below.end(10.0, number(0.0, 0.0, 0.0), number(-5.0, 0.0, 0.0), number(0.8, 0.2, -0.4));
  EXPECT_DOUBLE_EQ(dwell.value, -10.0 * 0.2 / 2.0);
  EXPECT_TRUE(dwell.gradient.isApprox(Vector2d(1.0, -2.0)));
}

TEST(BandStays, AJumpOverTheBandIsNoStay) {
  BandStays band = stays(WatchedSignal::Measure::kDwell);
  band.begin(0.0, 0.0);
  const Differentiated dwell =
      band.end(10.0, number(4.0, 1.0, 1.0), number(0.0, 1.0, 1.0), number(4.0, 1.0, 1.0));
  EXPECT_EQ(dwell.value, 0.0);
  EXPECT_EQ(dwell.gradient, Eigen::VectorXd(Vector2d(0.0, 0.0)));
}

TEST(BandStays, CrossingsMoveAgainstTheSlope) {
  const BandStays band = stays(WatchedSignal::Measure::kDwell);
  EXPECT_TRUE(band.by_crossing(true, -2.0, Vector2d(3.0, 1.0)).isApprox(Vector2d(1.5, 0.5)));
}

}  // namespace
}  // namespace codesign
