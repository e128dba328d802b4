// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/signal_rows.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

Study rows_study() {
  Study study;
  study.duration = 1.0;
  WatchedSignal path;
  path.lower = Quantity(-2.0);
  path.upper = Quantity(3.0);
  path.before = 1.0;
  WatchedSignal final = path;
  final.role = WatchedSignal::Role::kFinal;
  final.after = 1.0;
  final.lower = final.upper = Quantity(0.5);
  WatchedSignal peak = path;
  peak.role = WatchedSignal::Role::kPeak;
  study.watched = {path, final, peak};
  return study;
}

TEST(SignalRows, AreThoseOfEveryInstantAndWindow) {
  const Study study = rows_study();
  const SignalRows rows(study);
  const std::size_t instants = rows.layout().entries()[0].instants.size(), per_bound = 2 * instants - 1;
  EXPECT_EQ(rows.inequalities().size(), 4 * per_bound);
  EXPECT_EQ(rows.equalities().size(), 1U);
  EXPECT_EQ(rows.peaks(), std::vector<std::size_t>{2});
}

TEST(SignalRows, MeasureTheViolation) {
  const Study study = rows_study();
  const SignalRows rows(study);
  Extremes extremes;
  extremes.values.setZero(rows.layout().size());
  EXPECT_EQ(rows.violation(0, extremes, {}), 0.0);
  EXPECT_EQ(rows.violation(1, extremes, {}), 0.5);
  EXPECT_EQ(rows.violation(2, extremes, {}), 0.0) << "a peak has no bounds";
  extremes.values[rows.layout().entries()[0].largest(2)] = 3.25;
  extremes.values[rows.layout().entries()[0].smallest(5)] = -2.5;
  EXPECT_EQ(rows.violation(0, extremes, {}), 0.5);
}

}  // namespace
}  // namespace codesign
