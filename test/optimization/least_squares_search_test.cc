// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/least_squares_search.h"

#include <gtest/gtest.h>

#include <string>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

const char* const kSquares = "{algorithm: levenberg_marquardt, relative_tolerance: 1.0e-9}";
const char* const kSlsqp = "{algorithm: slsqp, relative_tolerance: 1.0e-11}";

TEST(LeastSquaresSearch, FindsTheOptimumOfOtherAlgorithms) {
  const OptimizationResult squares = optimize(block("", kSquares)), slsqp = optimize(block("", kSlsqp));
  ASSERT_TRUE(squares.status.ok()) << squares.status.cause;
  EXPECT_EQ(squares.termination, "objective_tolerance_reached");
  EXPECT_NEAR(squares.objective, slsqp.objective, 1e-7 * slsqp.objective);
  EXPECT_EQ(squares.initial_objective, slsqp.initial_objective) << "the same bits of the same evaluation";
  EXPECT_EQ(squares.initial_gradient, slsqp.initial_gradient);
  EXPECT_EQ(squares.influences, std::vector<bool>(2, true));
  EXPECT_LT(squares.evaluations, 40);
}

TEST(LeastSquaresSearch, TakesTheMeanOfRunsAndSamples) {
  const std::string blocks =
      "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}, weight: 2.0}}\nuncertain: {mu: {uniform: [0.2, 0.4]}}\n"
      "robust: {measure: mean, samples: 4}\n";
  const OptimizationResult squares = optimize(block(blocks, kSquares)), slsqp = optimize(block(blocks, kSlsqp));
  ASSERT_TRUE(squares.status.ok()) << squares.status.cause;
  EXPECT_NEAR(squares.objective, slsqp.objective, 1e-6 * slsqp.objective);
  EXPECT_EQ(squares.values.size(), 8);
}

TEST(LeastSquaresSearch, ResultsDoNotDependOnTheNumberOfWorkers) {
  const std::string uncertain = "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {measure: mean, samples: 4}\n";
  const OptimizationResult one = optimize(block(uncertain + "engine: {type: serial}\n", kSquares));
  const OptimizationResult two = optimize(block(uncertain + "engine: {type: threads, workers: 2}\n", kSquares));
  EXPECT_EQ(one.rho, two.rho);
  EXPECT_EQ(one.evaluations, two.evaluations);
}

TEST(LeastSquaresSearch, StartsFromManyPoints) {
  const OptimizationResult many = optimize(block("multistart: {starts: 4, screen: 8}\n", kSquares));
  ASSERT_TRUE(many.status.ok()) << many.status.cause;
  EXPECT_EQ(many.starts.size(), 4u);
  EXPECT_LE(many.objective, optimize(block("", kSquares)).objective * (1.0 + 1e-8));
}

/// A sentence about the fault of a study; empty if it has none. @param trials receives the number of trial points.
InputFault refusal(const std::string& blocks, int* trials) {
  try {
    optimize(block(blocks, kSquares), [trials](const Trial&) { return ++*trials > 0; });
  } catch (const InputError& error) {
    return error.fault();
  }
  return {};
}

TEST(LeastSquaresSearch, RefusesWhatIsNoSumOfSquaresBeforeAnythingIsComputed) {
  const std::string runs = "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}}}\n";
  for (const std::string& blocks :
       {runs + "robust: {measure: worst}\n", runs + "robust: {measure: cvar}\n", runs + "robust: {measure: mean_plus_deviation}\n",
        std::string("constraints: [\"Kp >= Kd\"]\n"), std::string("multistart: {starts: 2, screen: 4}\nconstraints: [\"Kp >= Kd\"]\n"),
        std::string("path: [{signal: slide/position, between: [-1.0, 2.0]}]\n"), std::string("solver: {gradient: adjoint}\n")}) {
    int trials = 0;
    const InputFault fault = refusal(blocks, &trials);
    EXPECT_EQ(fault.element, "optimizer.algorithm") << blocks;
    EXPECT_EQ(fault.message.rfind("this algorithm ", 0), 0u) << blocks << fault.message;
    EXPECT_NE(fault.allowed.find("slsqp"), std::string::npos) << blocks << fault.allowed;
    EXPECT_EQ(fault.allowed.find("levenberg"), std::string::npos) << blocks;
    EXPECT_EQ(trials, 0) << blocks;
  }
}

TEST(LeastSquaresSearch, CancelKeepsTheBestPoint) {
  const OptimizationResult result = optimize(block("", kSquares), [](const Trial& trial) { return trial.evaluation < 3; });
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_EQ(result.evaluations, 3);
  EXPECT_LE(result.objective, result.initial_objective);
  EXPECT_EQ(result.gradient.size(), 2);
}

TEST(LeastSquaresSearch, EndsAtTheLimitOfEvaluations) {
  const OptimizationResult result =
      optimize(block("", "{algorithm: levenberg_marquardt, max_evaluations: 3, relative_tolerance: 1.0e-12}"));
  EXPECT_EQ(result.termination, "max_evaluations_reached");
  EXPECT_EQ(result.evaluations, 3);
  ASSERT_FALSE(result.warnings.empty());
}

}  // namespace
}  // namespace codesign
