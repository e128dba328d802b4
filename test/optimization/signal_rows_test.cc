// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "optimization/signal_rows.h"
#include "sampling/measure.h"

namespace codesign {
namespace {

RobustOptions options(RobustMeasure measure, double level = 0.5) {
  RobustOptions options;
  options.measure = measure;
  options.level = level;
  return options;
}

const Eigen::VectorXd kWeights = Eigen::VectorXd::Constant(4, 0.25);
const Eigen::Vector4d kPsi(1.0, 4.0, 2.0, 3.0);

TEST(SlackForm, MeansAndSingleScenariosNeedNone) {
  EXPECT_EQ(SlackForm(options(RobustMeasure::kMean), kWeights).variables(), 0);
  EXPECT_EQ(SlackForm(options(RobustMeasure::kMeanPlusDeviation), kWeights).constraints(), 0);
  EXPECT_EQ(SlackForm(options(RobustMeasure::kWorst), Eigen::VectorXd::Ones(1)).variables(), 0);
}

TEST(SlackForm, TheStartIsFeasibleAndItsObjectiveTheMeasure) {
  for (RobustMeasure kind : {RobustMeasure::kWorst, RobustMeasure::kCvar})
    for (double level : {0.1, 0.5, 0.6, 0.95}) {
      const RobustOptions o = options(kind, level);
      const SlackForm form(o, kWeights);
      const Measured measured = measure(o, kPsi, kWeights);
      const Eigen::VectorXd y = form.start(kPsi, measured.threshold);
      ASSERT_EQ(y.size(), form.variables());
      EXPECT_NEAR(form.objective(y), measured.value, 1e-14);
      for (int k = 0; k < form.variables(); ++k) EXPECT_GE(y[k], form.lower(k));
      for (int i = 0; i < form.constraints(); ++i) EXPECT_LE(form.constraint(i, kPsi[i], y), 1e-15);
    }
}

TEST(SlackForm, DerivativesAreThoseOfTheValues) {
  const SlackForm form(options(RobustMeasure::kCvar), kWeights);
  const Eigen::VectorXd y = form.start(kPsi, 2.5);
  for (int k = 0; k < form.variables(); ++k) {
    const Eigen::VectorXd moved = y + Eigen::VectorXd::Unit(y.size(), k);
    EXPECT_NEAR(form.objective(moved) - form.objective(y), form.gradient()[k], 1e-14);
    for (int i = 0; i < form.constraints(); ++i)
      EXPECT_NEAR(form.constraint(i, kPsi[i], moved) - form.constraint(i, kPsi[i], y),
                  form.by_slack(i, k), 1e-14);
  }
}

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
  const std::size_t instants = rows.layout().entries()[0].instants.size(),
                    per_bound = 2 * instants - 1;
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
