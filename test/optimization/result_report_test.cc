// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/result_report.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

const std::string kTwoRuns = "runs: {light: {}, wide: {}}\n";

OptimizationResult of_two_scenarios() {
  OptimizationResult r;
  r.ensemble.scenarios = {{"light", -1, 0.5, {{"mass", 1.0}}, 3.0, 2.0},
                          {"wide", 4, 0.5, {{"mu", 0.3}}, 5.0, 1.0}};
  return r;
}

TEST(ResultReport, TellsTheDesignTheObjectiveTheStopAndTheWarnings) {
  const Problem problem = block("constraints: [\"Kd <= 2.0*Kp\"]\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(has_design(problem, result));
  const std::string text = report(problem, result);
  for (const std::string part : {"parameter", "Kp", "Kd <= 2.0*Kp: margin ", "objective ", " -> ",
                                 " evaluations (0 failed)", "stationary to "})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  EXPECT_NE(text.find(result.termination + " after "), std::string::npos) << text;
  const std::string outcome = outcome_text(problem, result);
  EXPECT_EQ(text.substr(0, outcome.size()), outcome);
  EXPECT_EQ(text.find("warning ["), outcome.size()) << text;
  EXPECT_NE(text.find("warning [parameter_on_bound]: "), std::string::npos) << text;
}

TEST(ResultReport, ASearchWithoutAStartTellsWhy) {
  const Problem problem = block("");
  OptimizationResult result;
  result.status = {StatusCode::kAssemblyFailed, 0.0, "the loop does not close"};
  EXPECT_FALSE(has_design(problem, result));
  EXPECT_NE(report(problem, result).find("the loop does not close"), std::string::npos);
}

TEST(ResultReport, TellsTheValueAtRiskOfCvar) {
  OptimizationResult risky = of_two_scenarios();
  risky.ensemble.value_at_risk = 2.25;
  risky.ensemble.validation = Validation{100, 2, 1.5, 1.75, 1.5, 3.25};
  risky.ensemble.validation->value_at_risk = 2.5;
  risky.ensemble.validation->within = 0.875;
  const Problem asked =
      block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: cvar, level: 0.8}\n");
  EXPECT_EQ(ensemble_sentences(asked, risky).at(1),
            "with a probability of 0.8 the objective is at most 2.25 on these samples, and at most "
            "2.5 on fresh samples, of which 87.5 % do not exceed the first value");
}

TEST(ResultReport, CountsSearchesAndOptima) {
  OptimizationResult r = of_two_scenarios();
  r.ensemble.validation = Validation{100, 2, 1.5, 1.75, 1.5, 3.25};
  r.multistart.starts.resize(2);
  r.multistart.starts[0].optimum = 0;
  r.multistart.optima = {{Eigen::Vector2d(3.0, 4.0), 0.5, 1}};
  r.multistart.screened = 8;
  r.multistart.unusable = 3;
  const std::vector<std::string> lines = ensemble_sentences(block(kTwoRuns), r);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "objective: mean over 2 scenarios; the worst is run \"light\", with 2");
  EXPECT_NE(lines[1].find("1.75 instead of 1.5"), std::string::npos) << lines[1];
  EXPECT_EQ(lines[2],
            "8 points screened, 3 of them unusable; 2 searches, 1 of them without an optimum");
  EXPECT_EQ(lines[3], "optimum 1: objective 0.5, found by 1 searches");
  EXPECT_TRUE(ensemble_sentences(block(""), OptimizationResult()).empty());
}

TEST(ResultReport, TheWorstIsAScenarioThatCouldBeIntegrated) {
  OptimizationResult r = of_two_scenarios();
  EXPECT_EQ(worst_scenario(r), 0);
  r.ensemble.scenarios[0].failed = true;
  r.best.failed = {0};
  r.ensemble.scenarios[1].friction_law = "gonthier";
  EXPECT_EQ(worst_scenario(r), 1);
  EXPECT_EQ(worst_scenario(OptimizationResult()), -1);
  const std::string line = ensemble_sentences(block(kTwoRuns), r)[0];
  EXPECT_NE(line.find("the worst is run \"wide\", sample 5 (gonthier), with 1; 1 failed"),
            std::string::npos)
      << line;
}

TEST(ResultReport, TellsByHowMuchASignalIsBeyondItsBounds) {
  OptimizationResult result;
  WatchedResult& watched = result.constraints.watched.emplace_back();
  watched.element = "path[0]";
  watched.signal = "hinge/effort";
  watched.largest = 2.5;
  EXPECT_EQ(watched_sentences(result).at(0), "path[0], hinge/effort: from 0 ... 0 to 0 ... 2.5");
  watched.violation = 0.5;
  EXPECT_NE(watched_sentences(result).at(0).find("beyond its bounds by 0.5"), std::string::npos);
}

}  // namespace
}  // namespace codesign
