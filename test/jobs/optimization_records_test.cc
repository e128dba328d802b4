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
  EXPECT_EQ(object["objective"], result.best.objective);
  EXPECT_EQ(object["initial_parameters"]["length"], 0.5);
  EXPECT_EQ(object["parameters"]["length"], result.best.rho[0]);
  EXPECT_EQ(object["parameters"].size(), 3U) << "those that are not tuned, too";
  EXPECT_EQ(object["gradient"]["Kp"], result.best.gradient[1]);
}

TEST(OptimizationRecords, ASearchWithoutAStartHasNoDesign) {
  const Problem problem = pendulum();
  OptimizationResult result;
  result.status.code = StatusCode::kAssemblyFailed;
  result.termination = "start_failed";
  const Json object = optimization_json(problem, result);
  EXPECT_FALSE(object.contains("parameters"));
  EXPECT_EQ(object["termination"], "start_failed");
}

OptimizationResult result() {
  OptimizationResult r;
  r.ensemble.scenarios = {{"light", -1, 0.5, {{"mass", 1.0}}, 3.0, 2.0},
                          {"wide", 4, 0.5, {{"mu", 0.3}}, 5.0, 1.0}};
  r.ensemble.validation = Validation{100, 2, 1.5, 1.75, 1.5, 3.25};
  r.multistart.starts = {
      {Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(3.0, 4.0), 9.0, 0.5, {}, "success", 12, 0},
      {Eigen::Vector2d(5.0, 6.0),
       Eigen::Vector2d(5.0, 6.0),
       10.0,
       10.0,
       {StatusCode::kUnstableMotion, 0.1, "fast"},
       "start_failed",
       1,
       -1}};
  r.multistart.optima = {{Eigen::Vector2d(3.0, 4.0), 0.5, 1}};
  r.multistart.screened = 8;
  r.multistart.unusable = 3;
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
  risky.ensemble.value_at_risk = 2.25;
  risky.ensemble.validation->value_at_risk = 2.5;
  risky.ensemble.validation->within = 0.875;
  add_ensemble(block(""), risky, &object);
  EXPECT_EQ(object["value_at_risk"], 2.25);
  EXPECT_EQ(object["validation"]["value_at_risk"], 2.5);
  EXPECT_EQ(object["validation"]["within"], 0.875);
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

TEST(EnsembleRecords, TheWorstIsOneThatCouldBeIntegrated) {
  OptimizationResult r = result();
  r.ensemble.scenarios[0].failed = true;
  r.best.failed = {0};
  r.ensemble.scenarios[0].friction_law = r.ensemble.scenarios[1].friction_law = "gonthier";
  Json object;
  add_ensemble(block(""), r, &object);
  EXPECT_EQ(object["failed_scenarios"], 1);
  EXPECT_EQ(object["scenarios"][0]["failed"], true);
  EXPECT_EQ(object["worst_scenario"]["run"], "wide");
  EXPECT_EQ(object["worst_scenario"]["friction_law"], "gonthier");
  EXPECT_EQ(scenario_columns(r)[7], "friction_law");
  EXPECT_EQ(scenario_rows(r)[0][6], "1");
  EXPECT_EQ(scenario_rows(r)[1][7], "gonthier");
}

TEST(EnsembleRecords, OneRunAndOneStartAddNothing) {
  Json object = Json::object();
  add_ensemble(block(""), OptimizationResult(), &object);
  EXPECT_TRUE(object.empty());
}

}  // namespace

}  // namespace codesign
