// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "jobs/json.h"
#include "jobs/optimization_records.h"
#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

TEST(OptimizationRecords, HoldBothDesigns) {
  const Problem problem = pendulum();
  const OptimizationResult result = optimize(problem);
  const Json object = optimization_json(problem, result);
  EXPECT_EQ(object["objective"], result.objective);
  EXPECT_EQ(object["initial_parameters"]["length"], 0.5);
  EXPECT_EQ(object["parameters"]["length"], result.rho[0]);
  EXPECT_EQ(object["parameters"].size(), 3U) << "those that are not tuned, too";
  EXPECT_EQ(object["gradient"]["Kp"], result.gradient[1]);
}

TEST(OptimizationRecords, ASearchWithoutAStartHasNoDesign) {
  const Problem problem = pendulum();
  OptimizationResult result;
  result.status.code = StatusCode::kAssemblyFailed;
  result.termination = "start_failed";
  EXPECT_FALSE(has_design(problem, result));
  const Json object = optimization_json(problem, result);
  EXPECT_FALSE(object.contains("parameters"));
  EXPECT_EQ(object["termination"], "start_failed");
}

OptimizationResult result() {
  OptimizationResult r;
  r.scenarios = {{"light", -1, 0.5, {{"mass", 1.0}}, 3.0, 2.0},
                 {"wide", 4, 0.5, {{"mu", 0.3}}, 5.0, 1.0}};
  r.validation = Validation{100, 2, 1.5, 1.75, 1.5, 3.25};
  r.starts = {
      {Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(3.0, 4.0), 9.0, 0.5, {}, "success", 12, 0},
      {Eigen::Vector2d(5.0, 6.0),
       Eigen::Vector2d(5.0, 6.0),
       10.0,
       10.0,
       {StatusCode::kUnstableMotion, 0.1, "fast"},
       "start_failed",
       1,
       -1}};
  r.optima = {{Eigen::Vector2d(3.0, 4.0), 0.5, 1}};
  r.screened = 8;
  r.unusable = 3;
  return r;
}

TEST(EnsembleRecords, JsonHoldsScenariosValidationAndOptima) {
  Json object;
  add_ensemble(block(""), result(), &object);
  EXPECT_EQ(object["scenarios"].size(), 2u);
  EXPECT_EQ(object["scenarios"][0]["sample"], 0) << "the nominal values";
  EXPECT_EQ(object["scenarios"][1]["sample"], 5);
  EXPECT_EQ(object["scenarios"][1]["values"]["mu"], 0.3);
  EXPECT_EQ(object["validation"]["promised"], 1.5);
  EXPECT_EQ(object["validation"]["failed"], 2);
  EXPECT_EQ(object["multistart"]["starts"], 2);
  EXPECT_EQ(object["multistart"]["unusable"], 3);
  EXPECT_EQ(object["multistart"]["optima"][0]["parameters"]["Kd"], 4.0);
}

TEST(EnsembleRecords, TellTheValueAtRiskOfCvar) {
  Json object;
  add_ensemble(block(""), result(), &object);
  EXPECT_FALSE(object.contains("value_at_risk")) << "another measure";
  EXPECT_FALSE(object["validation"].contains("within"));
  OptimizationResult risky = result();
  risky.value_at_risk = 2.25;
  risky.validation->value_at_risk = 2.5;
  risky.validation->within = 0.875;
  add_ensemble(block(""), risky, &object);
  EXPECT_EQ(object["value_at_risk"], 2.25);
  EXPECT_EQ(object["validation"]["value_at_risk"], 2.5);
  EXPECT_EQ(object["validation"]["within"], 0.875);
  const Problem asked =
      block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: cvar, level: 0.8}\n");
  const std::string sentence = ensemble_sentences(asked, risky).at(1);
  EXPECT_EQ(sentence,
            "with a probability of 0.8 the objective is at most 2.25 on these samples, and at most "
            "2.5 on fresh samples, of which 87.5 % do "
            "not exceed the first value");
}

TEST(EnsembleRecords, TablesHaveOneRowPerSearchAndScenario) {
  const std::vector<std::string> columns = start_columns(block(""));
  const auto starts = start_rows(result()), scenarios = scenario_rows(result());
  ASSERT_EQ(starts.size(), 2u);
  EXPECT_EQ(starts[0].size(), columns.size());
  EXPECT_EQ(columns[7], "start_Kp");
  EXPECT_EQ(starts[0][7], "1");
  EXPECT_EQ(starts[0][9], "3");
  EXPECT_EQ(starts[1][3], "unstable_motion");
  EXPECT_EQ(starts[1][6], "0") << "found no optimum";
  EXPECT_EQ(scenario_columns(result()),
            (std::vector<std::string>{"run", "sample", "weight", "initial_objective", "objective",
                                      "initial_failed", "failed", "mass", "mu"}));
  EXPECT_EQ(scenarios[0],
            (std::vector<std::string>{"light", "0", "0.5", "3", "2", "0", "0", "1", ""}));
  EXPECT_EQ(scenarios[1].back(), "0.3");
}

TEST(EnsembleRecords, SentencesCountSearchesAndOptima) {
  const std::vector<std::string> lines = ensemble_sentences(block("runs: {a: {}}\n"), result());
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "objective: mean over 2 scenarios; the worst is run \"light\", with 2");
  EXPECT_NE(lines[1].find("1.75 instead of 1.5"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("2 searches, 1 of them without an optimum"), std::string::npos)
      << lines[2];
  EXPECT_NE(lines[3].find("optimum 1: objective 0.5, found by 1 searches"), std::string::npos)
      << lines[3];
}

TEST(EnsembleRecords, TheWorstIsOneThatCouldBeIntegrated) {
  OptimizationResult r = result();
  EXPECT_EQ(worst_scenario(r), 0);
  r.scenarios[0].failed = true;
  r.failed = {0};
  r.scenarios[0].friction_law = r.scenarios[1].friction_law = "gonthier";
  EXPECT_EQ(worst_scenario(r), 1);
  EXPECT_EQ(worst_scenario(OptimizationResult()), -1);
  Json object;
  add_ensemble(block(""), r, &object);
  EXPECT_EQ(object["failed_scenarios"], 1);
  EXPECT_EQ(object["scenarios"][0]["failed"], true);
  EXPECT_EQ(object["worst_scenario"]["run"], "wide");
  EXPECT_EQ(object["worst_scenario"]["friction_law"], "gonthier");
  EXPECT_EQ(scenario_columns(r)[7], "friction_law");
  EXPECT_EQ(scenario_rows(r)[0][6], "1");
  EXPECT_EQ(scenario_rows(r)[1][7], "gonthier");
  const std::string line = ensemble_sentences(block("runs: {a: {}}\n"), r)[0];
  EXPECT_NE(line.find("the worst is run \"wide\", sample 5 (gonthier), with 1; 1 failed"),
            std::string::npos)
      << line;
}

TEST(EnsembleRecords, OneRunAndOneStartAddNothing) {
  Json object = Json::object();
  add_ensemble(block(""), OptimizationResult(), &object);
  EXPECT_TRUE(object.empty());
  EXPECT_TRUE(ensemble_sentences(block(""), OptimizationResult()).empty());
}

}  // namespace

}  // namespace codesign
