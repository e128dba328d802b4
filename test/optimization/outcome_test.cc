// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Statuses and terminations of searches; success only for a search that converged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assembly/make_system.h"
#include "description/study.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_results.h"
#include "paths.h"
#include "problem/load_problem.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

const SourceText kPendulum{"pendulum.urdf",
                           R"(<robot name="pendulum" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="length" value="1" lower="0.5" upper="2" unit="m"/>
  <codesign:parameter name="idle" value="3" lower="1" upper="5"/>
  <link name="ground"/>
  <link name="arm">
    <inertial>
      <origin xyz="0 0 -1" codesign:xyz="0 0 ${-length}"/>
      <mass value="3"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial>
  </link>
  <joint name="hinge" type="continuous"><parent link="ground"/><child link="arm"/><axis xyz="1 0 0"/></joint>
</robot>)"};

Problem problem_of(const std::string& more, const std::string& weight = "1",
                   const std::string& parameters = "length: {}") {
  return load_problem(kPendulum, {},
                      {"swing.yaml", R"(duration: 0.3
initial_state: {hinge: {position: 0.5}}
objective: {terminal: [{signal: hinge/position, reference: 0.1, weight: ")" +
                                         weight + R"("}]}
parameters: {)" + parameters + "}\n" + more});
}

OptimizationResult search(const Problem& problem) { return optimize(problem); }

bool has_warning(const Warnings& warnings, const std::string& code, const std::string& part = "") {
  return std::any_of(warnings.begin(), warnings.end(), [&](const Warning& warning) {
    return warning.code == code && warning.message.find(part) != std::string::npos;
  });
}

TEST(Outcome, OutsideTheConstraintsIsNoSuccess) {
  const OptimizationResult result =
      search(problem_of("constraints: [\"sqrt(length) >= 1.5\"]\noptimizer: {algorithm: slsqp}\n"));
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible);
  EXPECT_NE(result.status.cause.find("sqrt(length) >= 1.5"), std::string::npos)
      << result.status.cause;
  ASSERT_EQ(result.constraints.margins.size(), 1);
  EXPECT_NEAR(result.constraints.margins[0], std::sqrt(result.best.rho[0]) - 1.5, 1e-15);
  EXPECT_LT(result.constraints.margins[0], 0.0);
  EXPECT_EQ(result.best.gradient.size(), 1) << "the best point is kept";
}

// The tolerance only decides how the end is called: the search is the same.
TEST(Outcome, ABoundIsMetWithinItsTolerance) {
  const std::string slsqp = "\noptimizer: {algorithm: slsqp}\n",
                    bound = "{signal: hinge/position, between: [-2.0, -2.0]";
  const OptimizationResult strict = search(problem_of("final: [" + bound + "}]" + slsqp));
  EXPECT_EQ(strict.status.code, StatusCode::kInfeasible);
  ASSERT_EQ(strict.constraints.watched.size(), 1U);
  EXPECT_DOUBLE_EQ(strict.constraints.watched[0].tolerance, 2e-5);
  const OptimizationResult loose =
      search(problem_of("final: [" + bound + ", tolerance: 5.0}]" + slsqp));
  EXPECT_TRUE(loose.status.ok()) << loose.status.cause;
  EXPECT_EQ(loose.best.rho, strict.best.rho);
  EXPECT_GT(loose.constraints.watched[0].violation, 1.0);
  EXPECT_THROW(problem_of("final: [" + bound + ", tolerance: 0.0}]" + slsqp), InputError);
}

// A point that is asked for twice is one evaluation, and constraints of a point that the objective
// never saw are evaluations, too.
TEST(Outcome, EveryAlgorithmKeepsToTheLimitOfEvaluations) {
  const std::string path = "path: [{signal: hinge/velocity, at_least: -1.0, before: 0.3}]\n";
  for (const char* algorithm : {"lbfgs", "var1", "var2", "tnewton", "mma", "ccsaq", "slsqp",
                                "cobyla", "bobyqa", "auglag_lbfgs", "levenberg_marquardt"}) {
    const std::string name = algorithm;
    const bool takes_paths = name == "mma" || name == "ccsaq" || name == "slsqp" ||
                             name == "cobyla" || name == "auglag_lbfgs";
    for (const bool with_path : {false, true}) {
      if (with_path && !takes_paths) continue;
      for (const int most : {1, 2, 5}) {
        const OptimizationResult result =
            search(problem_of((with_path ? path : "") +
                                  "optimizer: {relative_tolerance: 1.0e-15, algorithm: " + name +
                                  ", max_evaluations: " + std::to_string(most) + "}\n",
                              "1", "length: {}, idle: {}"));
        EXPECT_LE(result.cost.evaluations, most) << name;
        const bool at_limit = result.termination == "max_evaluations_reached";
        EXPECT_TRUE(result.cost.evaluations == most || !at_limit)
            << name << ": " << result.cost.evaluations;
        EXPECT_TRUE(most > 1 || at_limit) << name << ": " << result.termination;
      }
    }
  }
}

TEST(Outcome, MarginsAreToldOfASuccessToo) {
  const OptimizationResult result = search(problem_of(
      "constraints: [\"length >= 0.9\", \"length <= 1.1\"]\noptimizer: {algorithm: slsqp}\n"));
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.constraints.margins.size(), 2);
  EXPECT_NEAR(result.constraints.margins[0], result.best.rho[0] - 0.9, 1e-15);
  EXPECT_NEAR(result.constraints.margins[1], 1.1 - result.best.rho[0], 1e-15);
}

TEST(Outcome, AConstraintThatIsNoNumberAtTheStartIsBadInput) {
  for (const char* constraint :
       {"sqrt(length - 1.5) >= 0", "1/(length - 1) >= 0", "log(length - 1) <= 0"}) {
    try {
      problem_of(std::string("constraints: [\"length >= 0\", \"") + constraint +
                 "\"]\noptimizer: {algorithm: slsqp}\n");
      ADD_FAILURE() << constraint;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what())
                    .find("swing.yaml:5: constraints[1]: the constraint is not a number"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Outcome, ASearchTurnsBackWhereAConstraintIsNoNumber) {
  const OptimizationResult result = search(
      problem_of("constraints: [\"sqrt(1.2 - length) >= -1\"]\noptimizer: {algorithm: mma}\n"));
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LE(result.best.rho[0], 1.2);
}

TEST(Outcome, AGradientThatIsNotFiniteIsNoSuccess) {
  const Problem problem = problem_of("", "${sqrt(length - 1)}");
  const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
  EXPECT_EQ(evaluation.status.code, StatusCode::kNonFiniteGradient);
  EXPECT_NE(evaluation.status.cause.find("\"length\""), std::string::npos)
      << evaluation.status.cause;
  EXPECT_TRUE(Evaluator(problem).evaluate(problem.start(), false).status.ok());
  EXPECT_EQ(search(problem).status.code, StatusCode::kNonFiniteGradient);
  for (const CheckMethod method : {CheckMethod::kComplexStep, CheckMethod::kRidders})
    EXPECT_EQ(check_gradient(system_of(problem), problem.start(), method).status.code,
              StatusCode::kNonFiniteGradient);
}

TEST(Outcome, AReferenceThatIsNotFiniteIsNoCheck) {
  // The objective exists to the right of the start alone, where the gradient is zero.
  const Problem problem = problem_of("", "${length >= 1 ? 1 : sqrt(length - 1)}");
  EXPECT_TRUE(Evaluator(problem).evaluate(problem.start(), true).status.ok());
  EXPECT_FALSE(
      check_gradient(system_of(problem), problem.start(), CheckMethod::kRidders).status.ok());
}

TEST(Outcome, AnObjectiveThatIsNotFiniteIsNoSuccess) {
  const Problem problem = problem_of("", "1e308");
  Study study = study_of(problem);
  study.terminal.front().reference = Quantity(1e100);
  EXPECT_EQ(search(with_study(problem, study)).status.code, StatusCode::kNonFinite);
}

TEST(Outcome, WarnsOfParametersOnTheirBound) {
  // From a longer pendulum the end is nearer to the start and farther from the reference: the
  // shortest is best.
  const OptimizationResult result = search(problem_of(""));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.best.rho[0] == 0.5 || result.best.rho[0] == 2.0,
            has_warning(result.warnings, "parameter_on_bound", "length"))
      << result.best.rho[0];
  const OptimizationResult narrow = search(problem_of("", "1", "length: {lower: 0.9, upper: 1.1}"));
  EXPECT_TRUE(has_warning(narrow.warnings, "parameter_on_bound", "length")) << narrow.best.rho[0];
}

Problem stop_problem(const std::string& model, const std::string& study,
                     const std::string& more = "") {
  const std::string folder = source_dir() + "/benchmark/stops/";
  SourceText text = read_source(folder + study + ".yaml");
  text.text += more;
  return load_problem(read_source(folder + model + ".urdf"), {}, text);
}

TEST(Outcome, NamesTheParametersOfAFlatOptimum) {
  for (const char* algorithm : {"auto", "lbfgs", "slsqp"}) {
    const Problem problem = stop_problem(
        "arm", "spring_balance", std::string("optimizer: {algorithm: ") + algorithm + "}\n");
    const OptimizationResult result = search(problem);
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_LT(result.best.objective, 1e-9 * result.initial.objective);
    ASSERT_EQ(result.optimality.flat_directions.cols(), 2)
        << algorithm << ": only the product of stiffness, post and hook counts";
    for (const char* name : {"stiffness", "post", "hook"})
      EXPECT_TRUE(has_warning(result.warnings, "flat_direction", name)) << algorithm;
    EXPECT_FALSE(has_warning(result.warnings, "parameter_on_bound")) << algorithm;
    // d log k + d log a + d log b = 0 along each of them.
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(
          result.optimality.flat_directions.col(d).cwiseQuotient(result.best.rho).sum(), 0.0,
          1e-5 * result.optimality.flat_directions.col(d).cwiseQuotient(result.best.rho).norm());
  }
  EXPECT_EQ(search(problem_of("")).optimality.flat_directions.cols(), 0);
}

TEST(Outcome, SaysHowStationaryItsPointIs) {
  const OptimizationResult result = search(stop_problem("arm", "arm_pid"));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.algorithm, "levenberg_marquardt") << "of a sum of squares";
  EXPECT_LE(result.optimality.stationarity, 1e-3);
  EXPECT_LT(result.best.slope, 1e-3 * result.initial.slope);
  EXPECT_EQ(stop_sentence(result).find("stationary to "), 0U) << stop_sentence(result);
  OptimizationResult early = result;
  early.termination = "stopped_early";
  early.best.slope = 0.4 * early.initial.slope;
  early.optimality.stationarity = 0.4;
  EXPECT_EQ(stop_sentence(early).find("stopped early: the slope is 0.4 of the start's"), 0U)
      << stop_sentence(early);
  const Problem problem = problem_of("");
  const Study& study = study_of(problem);
  early.best.rho = early.optimality.bound_multipliers = Eigen::VectorXd::Constant(1, 0.0);
  EXPECT_TRUE(has_warning(search_warnings(study, study.optimizer, early), "not_stationary",
                          "no algorithm gains"));
}

TEST(Outcome, WarnsOfParametersThatDoNothing) {
  const Problem problem = problem_of("", "1", "length: {}, idle: {}, mine: {initial: 1}");
  EXPECT_TRUE(has_warning(problem.warnings(), "unused_parameter", "${idle}"));
  EXPECT_TRUE(has_warning(problem.warnings(), "unused_parameter", "${mine}"));
  EXPECT_FALSE(has_warning(problem.warnings(), "unused_parameter", "${length}"));
  const OptimizationResult result = search(problem);
  EXPECT_TRUE(has_warning(result.warnings, "parameter_without_influence", "idle"));
  EXPECT_FALSE(has_warning(result.warnings, "parameter_without_influence", "length"));
}

TEST(Outcome, ABasisUsesItsCoefficientsWithoutNamingThem) {
  const Problem problem = problem_of(
      "controllers: {push: {type: basis, output: hinge, coefficients: {count: 3, lower: -1, upper: "
      "1}}}\n",
      "1", "length: {}");
  EXPECT_EQ(study_of(problem).tuned.size(), 4U);
  EXPECT_FALSE(has_warning(problem.warnings(), "unused_parameter"));
}

// Sensitivities that grow at each step end beyond any size before they overflow.
TEST(Outcome, AGradientBeyondAnySizeIsAFailure) {
  const auto evaluate = [](const std::string& factor) {
    const Problem problem = problem_of("", "${1 + " + factor + "*(length - 1)}");
    return Evaluator(problem).evaluate(problem.start(), true);
  };
  EXPECT_TRUE(evaluate("1e90").status.ok());
  const Evaluation absurd = evaluate("1e120");
  EXPECT_EQ(absurd.status.code, StatusCode::kNonFiniteGradient);
  EXPECT_NE(absurd.status.cause.find("beyond any size"), std::string::npos) << absurd.status.cause;
}

TEST(Outcome, WarnsOfASearchThatRanOutOfEvaluations) {
  const OptimizationResult result = search(problem_of("optimizer: {max_evaluations: 1}\n"));
  EXPECT_TRUE(result.status.ok());
  EXPECT_TRUE(has_warning(result.warnings, "max_evaluations_reached", "1"));
  EXPECT_FALSE(has_warning(search(problem_of("")).warnings, "max_evaluations_reached"));
}

TEST(Outcome, TolerancesBelowRoundingAreRefused) {
  for (const char* more :
       {"solver: {relative_tolerance: 1e-300}\n", "solver: {absolute_tolerance: 1e-17}\n",
        "solver: {sensitivity_tolerance: 1e-14}\n", "optimizer: {relative_tolerance: 1e-16}\n"})
    EXPECT_THROW(problem_of(more), InputError) << more;
  OptimizerOptions options;
  options.relative_tolerance = 0.0;
  EXPECT_THROW(optimize(problem_of(""), options), InputError) << "requests bring tolerances too";
}

}  // namespace
}  // namespace codesign
