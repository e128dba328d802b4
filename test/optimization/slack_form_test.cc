// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/slack_form.h"

#include <gtest/gtest.h>

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
      EXPECT_NEAR(form.constraint(i, kPsi[i], moved) - form.constraint(i, kPsi[i], y), form.by_slack(i, k), 1e-14);
  }
}

}  // namespace
}  // namespace codesign
