// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <chrono>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "ensemble/ensemble_fixture.h"
#include "optimization/search_hooks.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

class Notebook final : public EvaluationMemory {
 public:
  std::optional<Evaluation> find(const EvaluationTask& task) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto place = known_.find({task.system.get(), task.parameters, task.derivatives});
    return place == known_.end() ? std::nullopt : std::optional<Evaluation>(place->second);
  }
  void keep(const EvaluationTask& task, const Evaluation& evaluation) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    known_[{task.system.get(), task.parameters, task.derivatives}] = evaluation;
    if (++kept == cancel_at) cancel = true;
  }

  int kept = 0, cancel_at = -1;
  std::atomic<bool> cancel{false};

 private:
  std::mutex mutex_;
  std::map<std::tuple<const CompiledSystem*, std::vector<double>, Derivatives>, Evaluation> known_;
};

Problem nested(const std::string& measure = "worst", const std::string& algorithm = "slsqp") {
  return block(
      "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: " + measure +
          ", samples: 3, validate: 4}\nmultistart: {starts: 3, screen: 6}\nengine: {workers: 2}\n",
      "{algorithm: " + algorithm + "}");
}

void expect_to_go_on(const Problem& problem) {
  const OptimizerOptions options = problem.optimizer_options();
  const auto whole = std::make_shared<Notebook>();
  const OptimizationResult expected =
      run_search(problem, options, {nullptr, nullptr, whole}, nullptr);
  ASSERT_TRUE(expected.status.ok()) << expected.status.cause;
  for (const double part : {0.02, 0.3, 0.7, 0.98}) {
    const auto memory = std::make_shared<Notebook>();
    memory->cancel_at = static_cast<int>(part * whole->kept);
    run_search(problem, options, {nullptr, nullptr, memory}, &memory->cancel);
    EXPECT_LT(memory->kept, whole->kept);
    memory->cancel_at = -1;
    const OptimizationResult result =
        run_search(problem, options, {nullptr, nullptr, memory}, nullptr);
    EXPECT_EQ(memory->kept, whole->kept) << "nothing is computed twice";
    EXPECT_EQ(result.best.rho, expected.best.rho);
    EXPECT_EQ(result.best.objective, expected.best.objective);
    EXPECT_EQ(result.best.gradient, expected.best.gradient);
    EXPECT_EQ(result.cost.statistics.steps, expected.cost.statistics.steps);
    EXPECT_EQ(result.ensemble.validation->objective, expected.ensemble.validation->objective);
  }
}

TEST(SearchHooks, AnInterruptedSearchGoesOnFromItsMemory) { expect_to_go_on(nested()); }

TEST(SearchHooks, SoDoesOneThatNeedsTheJacobianOfTheResiduals) {
  expect_to_go_on(nested("mean", "levenberg_marquardt"));
}

TEST(SearchHooks, EveryStageIsTold) {
  const Problem problem = nested();
  std::vector<Progress> told;
  const auto keep = [&told](const Progress& progress) { told.push_back(progress); };
  const OptimizationResult result =
      run_search(problem, problem.optimizer_options(), {nullptr, keep, nullptr}, nullptr);
  ASSERT_TRUE(result.status.ok());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().stage, SearchStage::kScreening);
  EXPECT_EQ(told.front().done, 6);
  EXPECT_EQ(told.front().runs, 30);  // with the corners of the intervals
}

TEST(SearchHooks, ACallersMeterCountsTheWholeJob) {
  for (const Problem& problem : {nested(), block("engine: {workers: 2}\n")}) {
    const auto memory = std::make_shared<Notebook>();
    ProgressMeter first(1, nullptr), again(1, nullptr);
    run_search(problem, problem.optimizer_options(), {nullptr, nullptr, memory, nullptr, &first},
               nullptr);
    EXPECT_EQ(first.now().runs - first.now().remembered, memory->kept);
    run_search(problem, problem.optimizer_options(), {nullptr, nullptr, memory, nullptr, &again},
               nullptr);
    EXPECT_EQ(again.now().runs, first.now().runs);
    EXPECT_EQ(again.now().remembered, first.now().runs) << "nothing is computed twice";
  }
}

TEST(SearchHooks, CancelledWhileScreeningItKeepsTheBestPoint) {
  const Problem problem = block("multistart: {starts: 2, screen: 4000}\nengine: {workers: 2}\n");
  const auto memory = std::make_shared<Notebook>();
  memory->cancel_at = 20;
  const OptimizationResult result =
      run_search(problem, problem.optimizer_options(), {nullptr, nullptr, memory}, &memory->cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_GE(result.multistart.screened, 20);
  EXPECT_LT(result.multistart.screened, 1000) << "only those that were evaluated";
  EXPECT_NE(result.best.rho, problem.start());
  const auto start = memory->find({system_of(problem), problem.parameters(), Derivatives::kNone});
  ASSERT_TRUE(start);
  EXPECT_LT(result.best.objective, start->objective);
}

Trial trial(double objective, double best) {
  Trial t;
  t.evaluation = 7;
  t.objective = objective;
  t.best_objective = best;
  return t;
}

TEST(SharedObserver, NumbersTrialsThroughAndKeepsTheBestOfAll) {
  std::vector<Trial> seen;
  const TrialObserver keep = [&seen](const Trial& t) {
    seen.push_back(t);
    return true;
  };
  SharedObserver shared(keep);
  const TrialObserver first = shared.of(1), second = shared.of(2);
  EXPECT_TRUE(first(trial(3.0, 3.0)));
  EXPECT_TRUE(second(trial(5.0, 5.0)));
  EXPECT_TRUE(second(trial(2.0, 2.0)));
  Trial failed = trial(0.0, 0.0);
  failed.status.code = StatusCode::kNonFinite;
  EXPECT_TRUE(first(failed));
  ASSERT_EQ(seen.size(), 4u);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(seen[static_cast<std::size_t>(k)].evaluation, k + 1);
  EXPECT_EQ(seen[1].best_objective, 3.0);
  EXPECT_EQ(seen[1].start, 2);
  EXPECT_EQ(seen[1].iteration, 0);
  EXPECT_EQ(seen[2].best_objective, 2.0);
  EXPECT_EQ(seen[2].iteration, 1);
  EXPECT_EQ(seen[3].best_objective, 2.0) << "a failed trial has no objective";
}

TEST(SharedObserver, ALesserViolationIsBetterThanALowerObjective) {
  Trial last;
  const TrialObserver keep = [&last](const Trial& t) {
    last = t;
    return true;
  };
  SharedObserver shared(keep);
  Trial outside = trial(0.5, 0.5);
  outside.best_violation = 1.0;
  EXPECT_TRUE(shared.of(1)(outside));
  EXPECT_TRUE(shared.of(2)(trial(3.0, 3.0)));
  EXPECT_EQ(last.best_objective, 3.0);
  EXPECT_EQ(last.best_violation, 0.0);
  EXPECT_EQ(last.iteration, 1);
  EXPECT_TRUE(shared.of(1)(outside));
  EXPECT_EQ(last.best_objective, 3.0);
}

TEST(SharedObserver, OneRefusalEndsAllSearches) {
  int calls = 0;
  const TrialObserver refuse = [&calls](const Trial&) { return ++calls < 2; };
  SharedObserver shared(refuse);
  EXPECT_TRUE(shared.of(1)(trial(1.0, 1.0)));
  EXPECT_FALSE(shared.is_stopped());
  EXPECT_FALSE(shared.of(2)(trial(1.0, 1.0)));
  EXPECT_TRUE(shared.is_stopped());
  EXPECT_FALSE(shared.of(1)(trial(1.0, 1.0)));
  EXPECT_EQ(calls, 2) << "the observer is not asked again";
}

TEST(SharedObserver, WithoutAnObserverNothingStops) {
  const TrialObserver none;
  SharedObserver shared(none);
  EXPECT_TRUE(shared.of(1)(trial(1.0, 1.0)));
}

}  // namespace

}  // namespace codesign
