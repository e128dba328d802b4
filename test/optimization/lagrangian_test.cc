// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <string>

#include "description/tuned_parameters.h"
#include "ensemble/ensemble_fixture.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/lagrangian.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct Conditions {
  explicit Conditions(const Problem& of)
      : problem(of),
        ensemble(problem),
        scaling(study_of(problem)),
        parameters(study_of(problem), ensemble.scenarios()),
        program(ensemble) {}
  Optimality at(const Eigen::VectorXd& rho) {
    return optimality(ensemble.evaluate(rho, true), rho, scaling, parameters, &program);
  }

  const Problem problem;
  const Ensemble ensemble;
  const Scaling scaling;
  const ParameterRows parameters;
  SmoothProgram program;
};

const std::string kTight = "{algorithm: slsqp, relative_tolerance: 1.0e-11, max_evaluations: 400}";
const std::string kThreeRuns =
    "runs: {near: {}, far: {controllers: {hold: {setpoint: 0.7}}}, slow: {initial_state: {slide: "
    "{velocity: 0.2}}}}\n";

TEST(Lagrangian, HasNoGradientAtABoundedOptimum) {
  Conditions conditions(block("path: [{signal: hold/output, between: [-6, 6]}]\n", kTight));
  const OptimizationResult result = optimize(conditions.problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double free = conditions.scaling.gradient_norm(result.best.gradient);
  EXPECT_GT(free, 0.0);
  const Optimality optimum = conditions.at(result.best.rho);
  EXPECT_LT(optimum.slope, 1e-3 * free) << "the bound holds the gradient";
  EXPECT_GT(optimum.active.cols(), 0);
  EXPECT_EQ(result.best.slope, optimum.slope);
  // At the start the bound is not reached; a row may hold as much of the gradient as its distance
  // permits.
  const double start = conditions.at(conditions.problem.start()).slope;
  EXPECT_LE(start, conditions.scaling.gradient_norm(result.initial.gradient));
  EXPECT_GT(start, 100.0 * optimum.slope);
}

TEST(Lagrangian, WorstCaseAndTailAreStationaryInTheirSmoothForm) {
  for (const char* measure : {"worst", "cvar, level: 0.5"}) {
    Conditions conditions(block(kThreeRuns + "robust: {measure: " + measure + "}\n", kTight));
    const OptimizationResult result = optimize(conditions.problem);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_LT(result.optimality.stationarity, 1e-3) << measure;
    EXPECT_LT(result.best.slope, 1e-3 * result.initial.slope) << measure;
    Eigen::VectorXd beside = result.best.rho;
    beside[0] *= 1.1;
    EXPECT_GT(conditions.at(beside).slope, 10.0 * result.best.slope) << measure;
  }
}

// At the tolerance of an ordinary study: SLSQP alone stops where the tail of the first smooth form
// is level, far from the optimum.
TEST(Lagrangian, ATailAtLooseToleranceStopsWhereATightOneDoes) {
  const std::string runs = kThreeRuns + "robust: {measure: cvar, level: 0.5}\n";
  const OptimizationResult tight = optimize(block(runs, kTight));
  const OptimizationResult loose =
      optimize(block(runs, "{algorithm: slsqp, relative_tolerance: 1.0e-3}"));
  ASSERT_TRUE(tight.status.ok() && loose.status.ok());
  EXPECT_LE(loose.best.objective, tight.best.objective * (1.0 + 1e-4));
  EXPECT_LT(loose.optimality.stationarity, 1e-2);
}

// Least squares come first and leave the constraint; the search ends where the constrained one
// does.
TEST(Lagrangian, AutoKeepsAnActiveConstraintAmongParameters) {
  const std::string constraint = "constraints: [\"Kp + 10*Kd <= 30\"]\n";
  const OptimizationResult constrained = optimize(block(constraint, kTight));
  const OptimizationResult automatic = optimize(block(constraint, "{algorithm: auto}"));
  ASSERT_TRUE(constrained.status.ok() && automatic.status.ok());
  ASSERT_NEAR(constrained.constraints.margins[0], 0.0, 1e-6) << "not active";
  EXPECT_EQ(automatic.algorithm, "levenberg_marquardt, slsqp");
  EXPECT_NEAR(automatic.best.objective, constrained.best.objective,
              1e-6 * constrained.best.objective);
}

// Thousands of rows of signals in 24 samples: the work is that of few matrices of the variables.
TEST(Lagrangian, ManySamplesWithBoundedSignalsTakeFewMatrices) {
  Conditions conditions(
      block("path: [{signal: slide/effort, between: [-30, 30]}]\nuncertain: {mu: {uniform: [0.1, "
            "0.5]}, mass: {normal: [2, 0.2]}}\n"
            "robust: {measure: cvar, level: 0.9, samples: 24}\n"));
  const Optimality start = conditions.at(conditions.problem.start());
  EXPECT_GT(conditions.program.inequalities(), 1500);
  EXPECT_GT(start.slope, 0.0);
  EXPECT_LT(start.factorizations, 100);
  const std::atomic<bool> cancel{true};
  const Eigen::VectorXd rho = conditions.problem.start();
  const Optimality cancelled =
      optimality(conditions.ensemble.evaluate(rho, true), rho, conditions.scaling,
                 conditions.parameters, &conditions.program, &cancel);
  EXPECT_LE(cancelled.factorizations, 3);
}

// Widening by 1 % of the range is worth what the multiplier says, also where a constraint holds the
// optimum.
TEST(Lagrangian, ABoundIsWorthItsMultiplier) {
  const auto tune = [](const std::string& constraint, double upper) {
    const Problem problem = block(constraint, kTight);
    Study study = study_of(problem);
    study.parameters[static_cast<std::size_t>(study.tuned[0])].upper = upper;
    return optimize(with_study(problem, study));
  };
  for (const char* constraint : {"", "constraints: [\"Kp + 10*Kd <= 60\"]\n"}) {
    const OptimizationResult result = tune(constraint, 30.0), wider = tune(constraint, 30.3);
    ASSERT_NEAR(result.best.rho[0], 30.0, 1e-9) << constraint;
    ASSERT_LT(result.optimality.bound_multipliers[0], 0.0) << constraint;
    const double worth = -0.01 * result.optimality.bound_multipliers[0];
    EXPECT_NEAR(result.best.objective - wider.best.objective, worth, 0.05 * worth) << constraint;
  }
}

TEST(ViolatedBounds, AreThoseBeyondTheTolerance) {
  WatchedResult met, violated;
  met.element = "path[0]";
  met.violation = 0.5 * kMostViolation;
  violated.element = "constraints[1]";
  violated.signal = "slide/effort";
  violated.smallest = -3.0;
  violated.largest = 2.0;
  violated.violation = 1.5;
  EXPECT_EQ(describe_violated({met, violated}),
            "no point was found that keeps the bounds of all signals: constraints[1] "
            "(slide/effort) goes from -3 to 2, beyond its bounds by 1.5 "
            "(tolerance: 1e-08)");
}

TEST(ViolatedBounds, TheToleranceFollowsTheRangeOfSignalAndBounds) {
  WatchedResult swing;
  EXPECT_EQ(tolerance_of_range(swing), kMostViolation);
  swing.initial_largest = 20.0;
  swing.smallest = -1.0;
  swing.lower = -3.0;
  EXPECT_DOUBLE_EQ(tolerance_of_range(swing), 3e-5)
      << "an infinite bound has no magnitude, and the start does not count";
}

TEST(ViolatedBounds, ARestIsNoViolation) {
  OptimizationResult result;
  Study study;
  EXPECT_TRUE(meets_constraints(study, result)) << "there are none";
  study.parameters.resize(1);
  study.constraints = {parse_constraint("a >= 3", {"a"}, {}, ""),
                       parse_constraint("a <= 3", {"a"}, {}, "")};
  result.constraints.watched.resize(2);
  result.constraints.watched[1].violation = 1e-9;
  result.constraints.margins = Eigen::Vector2d(0.0, 3.0);
  EXPECT_TRUE(meets_constraints(study, result));
  result.constraints.watched[1].violation = 1e-6;
  EXPECT_FALSE(meets_constraints(study, result));
  result.constraints.watched[1].violation = 0.0;
  result.constraints.margins[0] = -1e-3;
  EXPECT_FALSE(meets_constraints(study, result));
}

}  // namespace

}  // namespace codesign
