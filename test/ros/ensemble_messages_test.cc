// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/ensemble_messages.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

using Numbers = std::vector<double>;

TEST(EnsembleMessages, ScenariosAndTheWorstAreNumberedFromOne) {
  OptimizationResult result;
  result.scenarios = {{"light", -1, 0.5, {{"mass", 1.0}}, 3.0, 2.0}, {"heavy", 4, 0.5, {{"mass", 9.0}, {"mu", 0.25}}, 5.0, 4.0, "lugre"}};
  result.scenarios[0].failed = true;
  mechanism_codesign::OptimizeResult message;
  set_ensemble(result, &message);
  ASSERT_EQ(message.scenarios.size(), 2U);
  EXPECT_EQ(message.scenarios[0].run, "light");
  EXPECT_EQ(message.scenarios[0].sample, 0U);
  EXPECT_TRUE(message.scenarios[0].failed);
  EXPECT_FALSE(message.scenarios[0].initial_failed);
  EXPECT_EQ(message.scenarios[1].sample, 5U);
  EXPECT_EQ(message.scenarios[1].parameters, (std::vector<std::string>{"mass", "mu"}));
  EXPECT_EQ(message.scenarios[1].values, (Numbers{9.0, 0.25}));
  EXPECT_EQ(message.scenarios[1].friction_law, "lugre");
  EXPECT_EQ(message.scenarios[1].weight, 0.5);
  EXPECT_EQ(message.scenarios[1].initial_objective, 5.0);
  EXPECT_EQ(message.scenarios[1].objective, 4.0);
  EXPECT_EQ(message.worst, 2U);
  EXPECT_TRUE(message.validation.empty());
}

TEST(EnsembleMessages, Validation) {
  OptimizationResult result;
  result.validation = Validation{100, 2, 1.5, 1.75, 1.25, 3.25, 2.5, 0.875};
  result.value_at_risk = 2.25;
  mechanism_codesign::OptimizeResult message;
  set_ensemble(result, &message);
  ASSERT_EQ(message.validation.size(), 1U);
  const mechanism_codesign::Validation& validation = message.validation[0];
  EXPECT_EQ(validation.samples, 100U);
  EXPECT_EQ(validation.failed, 2U);
  EXPECT_EQ((Numbers{validation.promised, validation.objective, validation.mean, validation.worst}), (Numbers{1.5, 1.75, 1.25, 3.25}));
  EXPECT_EQ((Numbers{message.value_at_risk, validation.value_at_risk, validation.within}), (Numbers{2.25, 2.5, 0.875}));
}

TEST(EnsembleMessages, SearchesNameTheirOptimum) {
  OptimizationResult result;
  const Eigen::Vector2d start(1.0, 2.0), end(3.0, 4.0);
  result.starts = {{start, end, 9.0, 0.5, {}, "objective_tolerance_reached", 12, 0},
                   {start, start, 10.0, 10.0, {StatusCode::kUnstableMotion, 0.1, "too fast"}, "start_failed", 1, -1}};
  result.optima = {{end, 0.5, 1}};
  result.screened = 8;
  result.unusable = 3;
  mechanism_codesign::OptimizeResult message;
  set_ensemble(result, &message);
  ASSERT_EQ(message.searches.size(), 2U);
  EXPECT_EQ(message.searches[0].start, (Numbers{1.0, 2.0}));
  EXPECT_EQ(message.searches[0].end, (Numbers{3.0, 4.0}));
  EXPECT_EQ(message.searches[0].start_objective, 9.0);
  EXPECT_EQ(message.searches[0].objective, 0.5);
  EXPECT_EQ(message.searches[0].code, "success");
  EXPECT_EQ(message.searches[0].message, "");
  EXPECT_EQ(message.searches[0].termination, "objective_tolerance_reached");
  EXPECT_EQ(message.searches[0].evaluations, 12U);
  EXPECT_EQ(message.searches[0].optimum, 1U);
  EXPECT_EQ(message.searches[1].code, "unstable_motion");
  EXPECT_NE(message.searches[1].message.find("too fast"), std::string::npos);
  EXPECT_EQ(message.searches[1].optimum, 0U);
  ASSERT_EQ(message.optima.size(), 1U);
  EXPECT_EQ(message.optima[0].values, (Numbers{3.0, 4.0}));
  EXPECT_EQ(message.optima[0].found, 1U);
  EXPECT_EQ(message.screened, 8U);
  EXPECT_EQ(message.unusable, 3U);
}

TEST(EnsembleMessages, OneRunAndOneStartAddNothing) {
  mechanism_codesign::OptimizeResult message;
  set_ensemble(OptimizationResult(), &message);
  EXPECT_EQ(message, mechanism_codesign::OptimizeResult());
}

}  // namespace
}  // namespace codesign
