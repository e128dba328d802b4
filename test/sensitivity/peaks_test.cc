// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/peaks.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Study watched_study() {
  Study study;
  study.duration = 1.0;
  WatchedSignal& peak = study.watched.emplace_back();
  peak.role = WatchedSignal::Role::kPeak;
  peak.weight = 3.0;
  peak.before = 1.0;
  return study;
}

TEST(Peaks, AreTheGreatestMagnitudeTimesTheWeight) {
  const Study study = watched_study();
  const WatchLayout layout(study);
  Extremes extremes;
  extremes.values.setZero(layout.size());
  extremes.gradients.setZero(2, layout.size());
  const int place = layout.entries()[0].smallest(3);
  extremes.values[layout.entries()[0].largest(1)] = 1.5;
  extremes.values[place] = -2.0;
  extremes.gradients.col(place) = Eigen::Vector2d(0.5, -1.0);
  EXPECT_EQ(find_peak(layout.entries()[0], extremes.values).place, place);
  Eigen::VectorXd gradient = Eigen::Vector2d(1.0, 1.0);
  EXPECT_EQ(peak_terms(study, extremes, &gradient), 6.0);
  EXPECT_EQ(gradient, Eigen::VectorXd(Eigen::Vector2d(1.0 - 1.5, 1.0 + 3.0)));
}

TEST(Peaks, ConstraintsAddNothingToTheObjective) {
  Study study = watched_study();
  study.watched[0].role = WatchedSignal::Role::kPath;
  EXPECT_EQ(peak_terms(study, {}, nullptr), 0.0);
}

}  // namespace
}  // namespace codesign
