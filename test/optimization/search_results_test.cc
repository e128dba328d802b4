// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "optimization/local_search.h"
#include "optimization/search_results.h"
#include "problem/load_problem.h"

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
  ASSERT_EQ(result.ensemble.scenarios.size(), 8u);
  EXPECT_EQ(result.ensemble.scenarios[4].run, "heavy");
  EXPECT_EQ(result.ensemble.scenarios[5].sample, 1);
  ASSERT_EQ(result.ensemble.scenarios[5].values.size(), 2u);
  EXPECT_EQ(result.ensemble.scenarios[5].values[0], (std::pair<std::string, double>("mass", 4.0)));
  EXPECT_EQ(result.ensemble.scenarios[5].values[1].first, "mu");
  double before = 0.0, after = 0.0;
  for (const ScenarioResult& scenario : result.ensemble.scenarios) {
    before += scenario.weight * scenario.initial_objective;
    after += scenario.weight * scenario.objective;
  }
  EXPECT_NEAR(before, result.initial.objective, 1e-12 * before);
  EXPECT_NEAR(after, result.best.objective, 1e-12 * after);
  ASSERT_TRUE(result.ensemble.validation);
  EXPECT_EQ(result.ensemble.validation->failed, 0);
  EXPECT_EQ(result.ensemble.validation->promised, result.best.objective);
  EXPECT_NEAR(result.ensemble.validation->objective, result.best.objective,
              0.1 * result.best.objective);
  EXPECT_NEAR(result.ensemble.validation->mean, result.ensemble.validation->objective, 1e-14)
      << "the measure is the mean";
  EXPECT_GT(result.ensemble.validation->worst, result.ensemble.validation->mean);
}

TEST(ScenarioResults, TellTheValueAtRisk) {
  const Problem problem = block(
      "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: cvar, level: 0.75, samples: 8, "
      "validate: 64}\n");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_TRUE(result.ensemble.value_at_risk);
  int beyond = 0;
  for (const ScenarioResult& scenario : result.ensemble.scenarios)
    beyond += scenario.objective > *result.ensemble.value_at_risk ? 1 : 0;
  EXPECT_EQ(beyond, 2) << "a quarter of the samples";
  EXPECT_LE(*result.ensemble.value_at_risk, result.best.objective)
      << "the mean of the worst quarter is beyond its edge";
  ASSERT_TRUE(result.ensemble.validation);
  EXPECT_NEAR(result.ensemble.validation->value_at_risk, *result.ensemble.value_at_risk,
              0.2 * result.best.objective);
  EXPECT_NEAR(result.ensemble.validation->within, 0.75, 0.15);
}

// With one sample there is no deviation; among the fresh samples its square overflows.
TEST(ScenarioResults, AValidationThatIsNotFiniteIsAFailure) {
  Problem problem = block(
      "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: mean_plus_deviation, samples: 1, "
      "validate: 4}\n",
      "{algorithm: slsqp, max_evaluations: 2}");
  Study study = study_of(problem);
  study.terminal.at(0).weight = 1e200;
  problem = with_study(problem, study);
  const OptimizationResult result = optimize(problem);
  EXPECT_EQ(result.status.code, StatusCode::kNonFinite) << result.status.cause;
  EXPECT_FALSE(result.ensemble.validation);
  EXPECT_GT(result.best.objective, 0.0) << "the best point is kept";
}

TEST(ScenarioResults, OtherMeasuresHaveNoValueAtRisk) {
  EXPECT_FALSE(optimize(block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 4}\n"))
                   .ensemble.value_at_risk);
}

TEST(ScenarioResults, StudiesWithOneRunHaveNone) {
  const OptimizationResult result = optimize(block(""));
  EXPECT_TRUE(result.ensemble.scenarios.empty());
  EXPECT_FALSE(result.ensemble.validation);
  EXPECT_TRUE(result.multistart.starts.empty());
}

TEST(ScenarioResults, AnInterruptedValidationIsNone) {
  const Problem problem =
      block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 2, validate: 500}\n");
  std::atomic<bool> cancel{false};
  // Half a validation is none: the samples left would count as failed.
  const auto progress = [&cancel](const Progress& so_far) {
    cancel = cancel || so_far.stage == SearchStage::kValidating;
  };
  const Ensemble ensemble(problem);
  ProgressMeter meter(100, progress, std::chrono::milliseconds(1));
  OptimizationResult result = search_locally(study_of(problem), problem.optimizer_options(),
                                             problem.start(), ensemble, {}, &cancel);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const Ensemble counted(
      problem, 1, {nullptr, [&meter](bool computed) { meter.count_run(computed); }, nullptr});
  describe_scenarios(problem, counted, &cancel, &meter, &result);
  EXPECT_TRUE(cancel);
  EXPECT_FALSE(result.ensemble.validation);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
}

const Eigen::MatrixXd kNoRows(3, 0);

TEST(FlatDirections, AProductLeavesTwoOfThree) {
  // r = k a b - 1 at (1, 2, 0.5): J = (1, 0.5, 2).
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(3, 3);
  root.row(0) << 1.0, 0.5, 2.0;
  const Eigen::MatrixXd flat = flat_directions(root, kNoRows, {false, false, false});
  ASSERT_EQ(flat.cols(), 2);
  EXPECT_LT((root * flat).norm(), 1e-14);
  for (int d = 0; d < 2; ++d) EXPECT_EQ(flat.col(d).cwiseAbs().maxCoeff(), 1.0);
  EXPECT_EQ((flat.array() == 1.0).rowwise().any().count(), 2)
      << "each direction has a parameter of its own";
}

TEST(FlatDirections, CurvatureAboveTheLimitIsNone) {
  Eigen::MatrixXd root = Eigen::Vector3d(1.0, 1e-3, 2e-4).asDiagonal();
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, false}).cols(), 0);
  root(2, 2) = 0.5e-4;
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, false}), Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(flat_directions(root, kNoRows, {false, false, true}).cols(), 0) << "held";
  EXPECT_EQ(flat_directions(root, Eigen::Vector3d(0.0, 0.0, 1e-6), {false, false, false}).cols(), 0)
      << "an active constraint";
}

}  // namespace

}  // namespace codesign
