// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/search_trials.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

class SearchTrialsTest : public testing::Test {
 protected:
  SearchTrials trials(const TrialObserver& observer, const std::atomic<bool>* cancel = nullptr) {
    return {study_of(problem_), options_, ensemble_, observer, cancel, scaling_, &program_};
  }
  const Problem problem_ = block("");
  const OptimizerOptions options_ = problem_.optimizer_options();
  const Ensemble ensemble_{problem_};
  const Scaling scaling_{study_of(problem_)};
  SmoothProgram program_{ensemble_};
  const TrialObserver none_;
};

TEST_F(SearchTrialsTest, TheBestPointIsKept) {
  std::vector<Trial> told;
  const TrialObserver observer = [&told](const Trial& trial) {
    told.push_back(trial);
    return true;
  };
  SearchTrials trials = this->trials(observer);
  trials.start(Eigen::Vector2d(20.0, 5.0));
  EXPECT_FALSE(trials.have_best());
  const Eigen::Vector2d better(60.0, 10.0), worse(1.0, 0.0);
  for (const Eigen::Vector2d& rho : {Eigen::Vector2d(20.0, 5.0), better, worse})
    ASSERT_TRUE(trials.evaluate(rho, Derivatives::kGradient));
  ASSERT_EQ(told.size(), 3u);
  ASSERT_LT(told[1].objective, told[0].objective);
  ASSERT_GT(told[2].objective, told[0].objective);
  EXPECT_EQ(told[2].best_objective, told[1].objective);
  EXPECT_EQ(told[2].iteration, 1);
  EXPECT_EQ(trials.last_rho(), worse);
  trials.conclude("");
  const OptimizationResult& result = trials.result();
  EXPECT_TRUE(result.status.ok());
  EXPECT_EQ(result.best.rho, better);
  EXPECT_EQ(result.best.objective, told[1].objective);
  EXPECT_EQ(result.best.gradient, told[1].gradient);
  EXPECT_EQ(result.initial.objective, told[0].objective);
  EXPECT_EQ(result.cost.evaluations, 3);
}

TEST_F(SearchTrialsTest, AnObserverOrACancelEndsTheSearch) {
  const TrialObserver enough = [](const Trial&) { return false; };
  SearchTrials stopped = trials(enough);
  stopped.start(problem_.start());
  EXPECT_FALSE(stopped.evaluate(problem_.start(), Derivatives::kGradient));
  EXPECT_TRUE(stopped.interrupted());
  stopped.conclude("");
  EXPECT_EQ(stopped.result().termination, "cancelled");
  EXPECT_EQ(stopped.result().status.code, StatusCode::kCancelled);
  EXPECT_EQ(stopped.result().cost.evaluations, 1) << "the trial counts that it was told of";
  const std::atomic<bool> cancel{true};
  SearchTrials cancelled = trials(none_, &cancel);
  cancelled.start(problem_.start());
  EXPECT_FALSE(cancelled.evaluate(problem_.start(), Derivatives::kGradient));
  EXPECT_EQ(cancelled.result().cost.evaluations, 0);
}

TEST_F(SearchTrialsTest, AnAlgorithmThatGaveUpSaysWhy) {
  SearchTrials trials = this->trials(none_);
  trials.start(problem_.start());
  ASSERT_TRUE(trials.evaluate(problem_.start(), Derivatives::kGradient));
  trials.result().termination = "algorithm_failed";
  trials.conclude("its matrix is singular");
  EXPECT_EQ(trials.result().status.code, StatusCode::kAlgorithmFailed);
  EXPECT_NE(trials.result().status.cause.find("its matrix is singular"), std::string::npos);
}

TEST(SearchTrials, OutsideTheConstraintsItDoesNotMatterHowTheAlgorithmEnded) {
  const Problem problem = block("final: [{signal: slide/position, at_least: 4.0}]\n");
  const OptimizerOptions options = problem.optimizer_options();
  const Ensemble ensemble(problem);
  const Scaling scaling(study_of(problem));
  const TrialObserver none;
  for (const bool has_failed : {false, true}) {
    SmoothProgram program(ensemble);
    SearchTrials trials(study_of(problem), options, ensemble, none, nullptr, scaling, &program);
    trials.start(problem.start());
    ASSERT_TRUE(trials.evaluate(problem.start(), Derivatives::kGradient));
    ASSERT_TRUE(trials.evaluate(Eigen::Vector2d(30.0, 5.0), Derivatives::kGradient));
    trials.result().termination = has_failed ? "algorithm_failed" : "objective_tolerance_reached";
    trials.conclude("its matrix is singular");
    EXPECT_EQ(trials.result().status.code, StatusCode::kInfeasible);
    EXPECT_NE(trials.result().status.cause.find("final[0] (slide/position)"), std::string::npos)
        << trials.result().status.cause;
    EXPECT_EQ(trials.result().status.cause.find("its matrix is singular") != std::string::npos,
              has_failed);
  }
  SmoothProgram program(ensemble);
  SearchTrials trials(study_of(problem), options, ensemble, none, nullptr, scaling, &program);
  trials.start(problem.start());
  ASSERT_TRUE(trials.evaluate(problem.start(), Derivatives::kGradient));
  trials.result().termination = "algorithm_failed";
  trials.conclude("its matrix is singular");
  EXPECT_EQ(trials.result().status.code, StatusCode::kAlgorithmFailed)
      << "it tried nothing but the start";
}

}  // namespace
}  // namespace codesign
