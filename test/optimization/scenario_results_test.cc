// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/scenario_results.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

TEST(ScenarioResults, NameRunsAndSamplesBeforeAndAfter) {
  const Problem problem = block(R"(
runs: {near: {}, heavy: {set: {mass: 4.0}}}
uncertain: {mu: {uniform: [0.2, 0.4]}}
robust: {samples: 4, validate: 10}
)");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.scenarios.size(), 8u);
  EXPECT_EQ(result.scenarios[4].run, "heavy");
  EXPECT_EQ(result.scenarios[5].sample, 1);
  ASSERT_EQ(result.scenarios[5].values.size(), 2u);
  EXPECT_EQ(result.scenarios[5].values[0], (std::pair<std::string, double>("mass", 4.0)));
  EXPECT_EQ(result.scenarios[5].values[1].first, "mu");
  double before = 0.0, after = 0.0;
  for (const ScenarioResult& scenario : result.scenarios) {
    before += scenario.weight * scenario.initial_objective;
    after += scenario.weight * scenario.objective;
  }
  EXPECT_NEAR(before, result.initial_objective, 1e-12 * before);
  EXPECT_NEAR(after, result.objective, 1e-12 * after);
  ASSERT_TRUE(result.validation);
  EXPECT_EQ(result.validation->failed, 0);
  EXPECT_EQ(result.validation->promised, result.objective);
  EXPECT_NEAR(result.validation->objective, result.objective, 0.1 * result.objective);
  EXPECT_NEAR(result.validation->mean, result.validation->objective, 1e-14) << "the measure is the mean";
  EXPECT_GT(result.validation->worst, result.validation->mean);
}

TEST(ScenarioResults, StudiesWithOneRunHaveNone) {
  const OptimizationResult result = optimize(block(""));
  EXPECT_TRUE(result.scenarios.empty());
  EXPECT_FALSE(result.validation);
  EXPECT_TRUE(result.starts.empty());
}

}  // namespace
}  // namespace codesign
