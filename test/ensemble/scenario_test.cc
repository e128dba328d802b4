// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "ensemble/ensemble_fixture.h"
#include "equations/compiled_system.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

TEST(Scenario, AStudyWithoutRunsIsItsOwnRun) {
  const Problem problem = block("");
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  ASSERT_EQ(scenarios.size(), 1u);
  EXPECT_EQ(scenarios[0].system, system_of(problem));
  EXPECT_EQ(scenarios[0].weight, 1.0);
  EXPECT_EQ(scenarios[0].name(), "");
  EXPECT_EQ(scenarios[0].parameters(problem.start()), problem.parameters());
}

TEST(Scenario, RunsTimesSamplesShareSamplesAndWeights) {
  const Problem problem = block(R"(
runs: {light: {set: {mass: 1.0}}, far: {weight: 3.0, controllers: {hold: {setpoint: 0.7}}}}
uncertain: {mu: {uniform: [0.2, 0.4]}}
robust: {samples: 4}
)");
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  ASSERT_EQ(scenarios.size(), 8u);
  double sum = 0.0;
  for (const Scenario& scenario : scenarios) sum += scenario.weight;
  EXPECT_NEAR(sum, 1.0, 1e-15);
  EXPECT_DOUBLE_EQ(scenarios[0].weight, 0.25 / 4.0);
  EXPECT_DOUBLE_EQ(scenarios[7].weight, 0.75 / 4.0);
  EXPECT_EQ(scenarios[5].name(), "run \"far\", sample 2");
  EXPECT_EQ(scenarios[0].system, system_of(problem))
      << "values of parameters need no system of their own";
  EXPECT_NE(scenarios[4].system, system_of(problem));
  const std::vector<double> light = scenarios[1].parameters(problem.start()),
                            far = scenarios[5].parameters(problem.start());
  EXPECT_EQ(light[0], far[0]) << "both runs see the same friction";
  EXPECT_GT(light[0], 0.2);
  EXPECT_LT(light[0], 0.4);
  EXPECT_EQ(light[1], 1.0);
  EXPECT_EQ(far[1], 2.0);
}

TEST(Scenario, OneSampleIsTheNominalOne) {
  const Problem problem = block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 1}\n");
  const std::vector<Scenario> scenarios = make_scenarios(problem);
  ASSERT_EQ(scenarios.size(), 1u);
  EXPECT_EQ(scenarios[0].parameters(problem.start()), problem.parameters());
}

TEST(Scenario, TheWorstCaseHasTheCornersAsSamples) {
  const std::string uncertain =
      "uncertain: {mu: {uniform: [0.2, 0.4]}, mass: {uniform: [1, 3]}}\nrobust: {samples: 4";
  EXPECT_EQ(make_scenarios(block(uncertain + "}\n")).size(), 4u);
  const std::vector<Scenario> worst = make_scenarios(block(uncertain + ", measure: worst}\n"));
  ASSERT_EQ(worst.size(), 8u);
  EXPECT_NEAR(worst[7].values[0].second, 0.4, 1e-10);
  EXPECT_NEAR(worst[7].values[1].second, 3.0, 1e-9);
  EXPECT_EQ(worst[7].sample, 7);
  EXPECT_DOUBLE_EQ(worst[0].weight, 0.125);
}

TEST(Scenario, AFrictionLawIsASystemOfItsOwn) {
  const Problem problem = block(
      "uncertain: {friction_law: {choice: [brown_mcphee, gonthier]}}\nrobust: {samples: 16}\n");
  int gonthier = 0;
  for (const Scenario& scenario : make_scenarios(problem))
    gonthier += scenario.system->layout().states > system_of(problem)->layout().states;
  EXPECT_GT(gonthier, 4) << "the law of Gonthier has states";
  EXPECT_LT(gonthier, 12);
}

TEST(Scenario, ValidationDrawsOtherSamples) {
  const Problem problem = block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 8}\n");
  const std::vector<Scenario> seen = make_scenarios(problem),
                              fresh = make_validation_scenarios(problem, 8);
  ASSERT_EQ(fresh.size(), 8u);
  for (const Scenario& scenario : fresh)
    EXPECT_TRUE(std::none_of(seen.begin(), seen.end(), [&](const Scenario& known) {
      return known.values == scenario.values;
    }));
}

}  // namespace
}  // namespace codesign
