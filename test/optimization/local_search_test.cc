// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/local_search.h"

#include <gtest/gtest.h>

#include <string>

#include "description/study.h"
#include "engine/thread_engine.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const std::string kRuns =
    "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}}, slow: {initial_state: {slide: "
    "{velocity: 0.2}}}}\n";

OptimizationResult tune(const std::string& robust, const std::string& optimizer) {
  return optimize(block(kRuns + "robust: {" + robust + "}\n", optimizer));
}

TEST(LocalSearch, TheWorstCaseIsLowerThanThatOfTheMean) {
  const std::string slsqp = "{algorithm: slsqp, relative_tolerance: 1.0e-9}";
  const OptimizationResult mean = tune("measure: mean", slsqp),
                           worst = tune("measure: worst", slsqp);
  ASSERT_TRUE(mean.status.ok()) << mean.status.cause;
  ASSERT_TRUE(worst.status.ok()) << worst.status.cause;
  EXPECT_EQ(worst.best.objective, worst.best.values.maxCoeff());
  EXPECT_LE(worst.best.objective, mean.best.values.maxCoeff() * (1.0 + 1e-9));
  EXPECT_LE(mean.best.objective, worst.best.values.mean() * (1.0 + 1e-9))
      << "and the mean is lowest where the mean was minimized";
  EXPECT_LT(worst.best.objective, worst.initial.objective);
}

TEST(LocalSearch, AlgorithmsWithConstraintsAgreeOnTheTail) {
  const OptimizationResult slsqp =
      tune("measure: cvar, level: 0.5", "{algorithm: slsqp, relative_tolerance: 1.0e-9}");
  const OptimizationResult mma =
      tune("measure: cvar, level: 0.5",
           "{algorithm: mma, relative_tolerance: 1.0e-9, max_evaluations: 400}");
  ASSERT_TRUE(slsqp.status.ok()) << slsqp.status.cause;
  ASSERT_TRUE(mma.status.ok()) << mma.status.cause;
  EXPECT_NEAR(mma.best.objective, slsqp.best.objective, 1e-4 * slsqp.best.objective);
}

TEST(LocalSearch, MeasuresWithConstraintsRefuseOtherAlgorithms) {
  EXPECT_THROW(tune("measure: worst", "{algorithm: lbfgs}"), InputError);
  EXPECT_TRUE(tune("measure: mean", "{algorithm: lbfgs}").status.ok());
}

/// An engine that loses its workers after some calls.
class LosingEngine final : public EvaluationEngine {
 public:
  explicit LosingEngine(int calls) : calls_(calls) {}
  std::vector<Evaluation> evaluate(const std::vector<EvaluationTask>& tasks,
                                   const std::atomic<bool>* cancel) override {
    std::vector<Evaluation> results = serial_.evaluate(tasks, cancel);
    if (calls_-- <= 0) results.back().status = {StatusCode::kWorkerLost, 0.0, "rank 1 is gone"};
    return results;
  }
  int workers() const override { return 1; }

 private:
  SerialEngine serial_;
  int calls_;
};

TEST(LocalSearch, ALostWorkerEndsTheSearchWithTheBestPoint) {
  const Problem problem = block(kRuns);
  for (const int calls : {0, 4}) {
    const Ensemble ensemble(make_scenarios(problem), {}, std::make_shared<LosingEngine>(calls));
    const OptimizationResult result = search_locally(study_of(problem), problem.optimizer_options(),
                                                     problem.start(), ensemble, {}, nullptr);
    EXPECT_EQ(result.status.code, StatusCode::kWorkerLost);
    EXPECT_EQ(result.status.cause, "rank 1 is gone; the best point so far is kept");
    EXPECT_EQ(result.termination, "worker_lost");
    EXPECT_EQ(result.cost.evaluations, calls) << "what was interrupted does not count";
    EXPECT_EQ(result.best.gradient.size() > 0, calls > 0);
  }
}

}  // namespace
}  // namespace codesign
