// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "identification/swinging_arm.h"

namespace codesign {
namespace {

using Numbers = std::vector<double>;

TEST(EnsembleMessages, ScenariosAndTheWorstAreNumberedFromOne) {
  OptimizationResult result;
  result.ensemble.scenarios = {{"light", -1, 0.5, {{"mass", 1.0}}, 3.0, 2.0},
                               {"heavy", 4, 0.5, {{"mass", 9.0}, {"mu", 0.25}}, 5.0, 4.0, "lugre"}};
  result.ensemble.scenarios[0].failed = true;
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
  result.ensemble.validation = Validation{100, 2, 1.5, 1.75, 1.25, 3.25, 2.5, 0.875};
  result.ensemble.value_at_risk = 2.25;
  mechanism_codesign::OptimizeResult message;
  set_ensemble(result, &message);
  ASSERT_EQ(message.validation.size(), 1U);
  const mechanism_codesign::Validation& validation = message.validation[0];
  EXPECT_EQ(validation.samples, 100U);
  EXPECT_EQ(validation.failed, 2U);
  EXPECT_EQ((Numbers{validation.promised, validation.objective, validation.mean, validation.worst}),
            (Numbers{1.5, 1.75, 1.25, 3.25}));
  EXPECT_EQ((Numbers{message.value_at_risk, validation.value_at_risk, validation.within}),
            (Numbers{2.25, 2.5, 0.875}));
}

TEST(EnsembleMessages, SearchesNameTheirOptimum) {
  OptimizationResult result;
  const Eigen::Vector2d start(1.0, 2.0), end(3.0, 4.0);
  result.multistart.starts = {{start, end, 9.0, 0.5, {}, "objective_tolerance_reached", 12, 0},
                              {start,
                               start,
                               10.0,
                               10.0,
                               {StatusCode::kUnstableMotion, 0.1, "too fast"},
                               "start_failed",
                               1,
                               -1}};
  result.multistart.optima = {{end, 0.5, 1}};
  result.multistart.screened = 8;
  result.multistart.unusable = 3;
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

TEST(IdentificationMessage, SaysWhatIsNotKnown) {
  IdentificationResult result;
  result.status = {StatusCode::kNotIdentifiable, 0.0, "the data do not determine all numbers"};
  IdentifiedNumber bound, unknown, profiled;
  bound.is_on_bound = true;
  unknown.is_determined = false;
  unknown.deviation = std::numeric_limits<double>::infinity();
  profiled.profile.emplace();
  profiled.profile->lower = 0.25;
  profiled.profile->upper = 0.75;
  profiled.profile->lower_end = ProfileEnd::kFound;
  profiled.profile->upper_end = ProfileEnd::kFailed;
  result.numbers = {bound, unknown, profiled};
  result.covariance = Eigen::MatrixXd::Identity(3, 3);
  result.covariance(0, 1) = 5.0;
  const auto message = identification_message(swinging_problem(), result);
  EXPECT_FALSE(message.success);
  EXPECT_EQ(message.code, "not_identifiable");
  EXPECT_EQ(message.message, "the data do not determine all numbers");
  EXPECT_TRUE(std::isnan(message.numbers[0].deviation) && std::isnan(message.numbers[0].low) &&
              std::isnan(message.numbers[0].high));
  EXPECT_FALSE(message.numbers[1].determined);
  EXPECT_TRUE(std::isinf(message.numbers[1].deviation));
  EXPECT_TRUE(std::isnan(message.numbers[1].profile_low));
  EXPECT_EQ(message.numbers[2].profile_low, 0.25);
  EXPECT_TRUE(std::isnan(message.numbers[2].profile_high));
  EXPECT_EQ(message.covariance[1], 5.0) << "row by row";
  EXPECT_EQ(message.level, 0.95);
  EXPECT_EQ(message.noise, "correlated");
  EXPECT_TRUE(message.parameters.empty()) << "without values";
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

WatchedResult watched() {
  WatchedResult result;
  result.element = "path[0]";
  result.signal = "slide/velocity";
  result.lower = -2.0;
  result.after = 0.1;
  result.before = 0.8;
  result.initial_smallest = -0.5;
  result.initial_largest = 1.0;
  result.smallest = -0.25;
  result.largest = 0.75;
  result.smallest_time = 0.3;
  result.largest_time = 0.2;
  result.largest_scenario = 4;
  result.violation = 0.25;
  return result;
}

TEST(WatchedMessages, TellBoundsAndRanges) {
  const auto messages = watched_messages({watched()}, true);
  ASSERT_EQ(messages.size(), 1U);
  const mechanism_codesign::WatchedSignal& message = messages[0];
  EXPECT_EQ(message.element, "path[0]");
  EXPECT_EQ(message.signal, "slide/velocity");
  EXPECT_EQ(message.lower, -2.0);
  EXPECT_EQ(message.upper, kInfinity);
  EXPECT_EQ(message.after, 0.1);
  EXPECT_EQ(message.before, 0.8);
  EXPECT_EQ(message.initial_smallest, -0.5);
  EXPECT_EQ(message.initial_largest, 1.0);
  EXPECT_EQ(message.smallest, -0.25);
  EXPECT_EQ(message.largest, 0.75);
  EXPECT_EQ(message.smallest_time, 0.3);
  EXPECT_EQ(message.largest_time, 0.2);
  EXPECT_EQ(message.smallest_scenario, 1U);
  EXPECT_EQ(message.largest_scenario, 5U);
  EXPECT_EQ(message.violation, 0.25);
}

TEST(WatchedMessages, NameNoScenarioWhereThereIsOne) {
  EXPECT_EQ(watched_messages({watched()}, false).at(0).largest_scenario, 0U);
  EXPECT_TRUE(watched_messages({}, true).empty());
}

TEST(Warnings, WarningsOfFilesComeFirstAndOnce) {
  const std::vector<mechanism_codesign::Warning> messages =
      warning_messages({{"a", "one", {}}}, {{"b", "two", {}}, {"a", "one", {}}});
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].code, "a");
  EXPECT_EQ(messages[1].message, "two");
}

}  // namespace
}  // namespace codesign
