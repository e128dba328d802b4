// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/worst_rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "optimization/search_results.h"
#include "problem/load_problem.h"

namespace codesign::worst_rounds {
namespace {

/// min over a of the largest (a - signal)^2, by a block that rests.
Problem problem_of(const std::string& signal, const std::string& uncertain,
                   const std::string& more = "") {
  const SourceText urdf{"block.urdf", R"(<robot name="block">
  <link name="ground"/>
  <link name="block"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="block"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
</robot>)"};
  return load_problem(
      urdf, {},
      {"block.yaml",
       "duration: 0.01\nparameters: {a: {initial: 3, lower: -10, upper: 10}, x: {tune: false, "
       "initial: 0.5}, y: {tune: false, initial: 0.5}}\nuncertain: {" +
           uncertain + "}\nobjective: {terminal: [{signal: \"${a - (" + signal +
           ") + 0*slide/position}\"}]}\n" + more});
}

bool has_code(const OptimizationResult& result, const std::string& code) {
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [&](const Warning& warning) { return warning.code == code; });
}

// Samples lie within the interval, its ends decide.
TEST(WorstRounds, ThePromiseHoldsAtTheEnds) {
  const OptimizationResult result =
      optimize(problem_of("x", "x: {uniform: [0, 1]}", "robust: {measure: worst, samples: 4}\n"));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.rho[0], 0.5, 1e-6);
  EXPECT_NEAR(result.best.objective, 0.25, 1e-8);
}

// 1 - 16 (x - 0.37)^2 goes from -5.3504 at one end to 1 within the interval.
TEST(WorstRounds, ThePromiseHoldsBetweenTheSamples) {
  for (const char* starts : {"", "multistart: {starts: 2, screen: 4}\n"}) {
    const Problem problem =
        problem_of("1 - 16*(x - 0.37)^2", "x: {uniform: [0, 1]}",
                   std::string("robust: {measure: worst, samples: 2}\n") + starts);
    std::vector<Trial> trials;
    const OptimizationResult result = optimize(problem, [&](const Trial& trial) {
      trials.push_back(trial);
      return true;
    });
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_NEAR(result.best.rho[0], -2.1752, 2e-3) << starts;
    EXPECT_NEAR(result.best.objective, 3.1752 * 3.1752, 1e-2) << starts;
    EXPECT_FALSE(has_code(result, "worst_between_samples")) << starts;
    EXPECT_EQ(result.initial.rho[0], 3.0);
    EXPECT_NEAR(result.initial.objective, 8.3504 * 8.3504, 1e-6) << "of the study's start";
    ASSERT_GT(result.ensemble.scenarios.size(), 4u) << "two samples, two corners, the worst point";
    double worst = 0.0;
    for (const ScenarioResult& one : result.ensemble.scenarios)
      worst = std::max(worst, one.objective);
    EXPECT_EQ(worst, result.best.objective);
    const ScenarioResult& last = result.ensemble.scenarios.back();
    EXPECT_NEAR(last.values.at(0).second, 0.37, 0.01);
    const Scenario again = scenario_of(problem, last);
    EXPECT_EQ(again.values.at(0).second, last.values.at(0).second);
    EXPECT_EQ(again.sample, last.sample);
    for (std::size_t k = 1; k < trials.size(); ++k)
      EXPECT_GT(trials[k].evaluation, trials[k - 1].evaluation) << "numbered on";
    if (*starts == '\0') {
      EXPECT_EQ(trials.back().evaluation, result.cost.evaluations);
    }
  }
}

TEST(WorstRounds, SeveralIntervalsHaveTheirCorners) {
  const OptimizationResult result =
      optimize(problem_of("3*x - 2*y", "x: {uniform: [0, 1]}, y: {uniform: [0, 1]}",
                          "robust: {measure: worst, samples: 2, sampler: random}\n"));
  EXPECT_NEAR(result.best.rho[0], 0.5, 1e-4);
  EXPECT_NEAR(result.best.objective, 6.25, 1e-3);
}

TEST(WorstRounds, WhatIsLeftIsTold) {
  const OptimizationResult result = optimize(
      problem_of("16*(x - 0.37)^2 - 1", "x: {uniform: [0, 1]}",
                 "robust: {measure: worst, samples: 2}\noptimizer: {max_evaluations: 1}\n"));
  EXPECT_LT(result.best.objective, 15.9) << "16 between the samples";
  EXPECT_TRUE(has_code(result, "worst_between_samples"));
  EXPECT_EQ(result.cost.evaluations, 1);
}

TEST(WorstRounds, OtherMeasuresKeepTheirSamples) {
  for (const char* measure : {"mean", "cvar"}) {
    const OptimizationResult result =
        optimize(problem_of("x", "x: {uniform: [0, 1]}",
                            std::string("robust: {samples: 4, measure: ") + measure + "}\n"));
    EXPECT_EQ(result.ensemble.scenarios.size(), 4u) << measure;
  }
}

}  // namespace
}  // namespace codesign::worst_rounds
