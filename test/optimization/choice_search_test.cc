// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/choice_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mechanism_codesign/gradient.h"
#include "optimization/cart.h"
#include "optimization/search_results.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

Problem cart(const std::string& study) {
  return load_problem(
      cart_urdf(), {}, {"cart.yaml", study}, {}, {}, [](const FileAddress& address) {
        return SourceText{address.file, "part,mass,damping\nsmall,0.5,0.9\nlarge,2.0,0.4\n"};
      });
}

/// The cart rests, so that the objective is a sum of squares of what the references say.
std::string squares(const std::string& parameters, const std::vector<std::string>& residuals) {
  std::string study = "duration: 0.1\nparameters: {" + parameters + "}\nobjective:\n  terminal:\n";
  for (const std::string& residual : residuals)
    study += "    - {signal: slide/position, reference: \"${" + residual + "}\"}\n";
  return study;
}

double valley(double x, double y) {
  return 10.0 * std::pow(x - y - 0.4, 2) + 0.1 * std::pow(x + y - 29.3, 2);
}

const char* const kValley =
    "x: {initial: 30, integer: [0, 40]}, y: {initial: 1, integer: [0, 40]}, z: {initial: 0.0, "
    "lower: -9.0, upper: 9.0}";
const std::vector<std::string> kResiduals{"sqrt(10)*(x - y - 0.4)", "sqrt(0.1)*(x + y - 29.3)",
                                          "z - 0.1*x"};

TEST(ChoiceSearch, WholeNumbersOfAQuadraticAreNotTheRoundedOnes) {
  double least = std::numeric_limits<double>::infinity();
  int best_x = -1, best_y = -1;
  for (int x = 0; x <= 40; ++x)
    for (int y = 0; y <= 40; ++y)
      if (valley(x, y) < least) least = valley(best_x = x, best_y = y);
  ASSERT_LT(least, valley(std::round(14.85), std::round(14.45))) << "the relaxation, rounded";
  const OptimizationResult result = optimize(cart(squares(kValley, kResiduals)));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.best.rho[0], best_x);
  EXPECT_EQ(result.best.rho[1], best_y);
  EXPECT_NEAR(result.best.rho[2], 0.1 * best_x, 1e-6);
  EXPECT_NEAR(result.best.objective, least, 1e-9);
  EXPECT_EQ(result.termination, "combinations_bounded");
  EXPECT_EQ(result.choice.combinations, 41.0 * 41.0);
  EXPECT_TRUE(result.choice.is_complete);
  EXPECT_GT(result.choice.bounded, 0);
  EXPECT_LT(result.choice.searched + result.choice.relaxations, 150) << "of 1681";
  EXPECT_EQ(result.choice.chosen[0], std::make_pair(std::string("x"), std::to_string(best_x)));
  EXPECT_EQ(result.initial.rho[0], 30.0);
  EXPECT_NEAR(result.initial.objective, valley(30.0, 1.0) + 9.0, 1e-9);
  EXPECT_EQ(result.optimality.bound_multipliers[0], 0.0);
  for (const Warning& warning : result.warnings) EXPECT_NE(warning.code, "parameter_on_bound");
}

TEST(ChoiceSearch, BoundsOfOtherParametersAreToldWhateverTheirNames) {
  const OptimizationResult result = optimize(
      cart(squares("a: {initial: 1, choice: [1, 2]}, beta: {initial: 0.5, lower: 0, upper: 1}",
                   {"a - 1.4", "beta - 3"})));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].code, "parameter_on_bound");
  EXPECT_NE(result.warnings[0].message.find("beta"), std::string::npos);
}

TEST(ChoiceSearch, CombinationsWhoseSearchEndedEarlyAreCounted) {
  const std::string study = squares(
      "x: {initial: 1, choice: [1, 2]}, a: {initial: -1.2, lower: -9, upper: 9}, b: {initial: 1.0, "
      "lower: -9, "
      "upper: 9}",
      {"x - 1.4", "10*(b - a**2)", "1 - a"});
  const OptimizationResult whole = optimize(cart(study));
  EXPECT_EQ(whole.choice.unfinished, 0);
  EXPECT_EQ(whole.termination, "all_combinations_searched");
  const OptimizationResult cut = optimize(cart(study + "optimizer: {max_evaluations: 3}\n"));
  EXPECT_EQ(cut.choice.searched, 2);
  EXPECT_EQ(cut.choice.unfinished, 2);
  EXPECT_NE(stop_sentence(cut).find("the search of 2 combinations ended before an optimum"),
            std::string::npos)
      << stop_sentence(cut);
}

const char* const kParts =
    "part: {choice: [{mass: 0.6, damping: 0.1}, {mass: 0.6, damping: 2.2}, {mass: 1.5, damping: "
    "0.2}, {mass: 2.2, damping: 0.9}, {mass: 1.6, damping: 3.7}, {mass: 3.4, damping: 1.7}, {mass: "
    "4.0, damping: 0.3}, {mass: 2.9, damping: 4.0}]}";

std::string servo(const std::string& parameters) {
  return R"(
duration: 4.0
initial_state: {slide: {position: 1.0, velocity: 0.0}}
controllers:
  hold: {type: state_feedback, output: slide, feedback: [{signal: slide/position, gain: "${k}"}, {signal: slide/velocity, gain: "${damping}"}]}
objective:
  integral: [{signal: slide/position}, {signal: hold/output, weight: 0.02}, {signal: slide/velocity, reference: "${0.3*mass-0.6}", weight: 0.1}]
optimizer: {relative_tolerance: 1.0e-9}
parameters: {damping: {initial: 1.0, tune: false}, )" +
         parameters + "}\n";
}

/// A catalogue of parts, whose numbers come together, with a whole number: 80 combinations.
TEST(ChoiceSearch, ACatalogueOfAMechanismIsThatOfAllCombinations) {
  const std::string whole = "k: {initial: 3, integer: [1, 10]}";
  const Problem problem = cart(servo(std::string(kParts) + ", " + whole));
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  Evaluator evaluator(problem);
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd best;
  const double parts[8][2] = {{0.6, 0.1}, {0.6, 2.2}, {1.5, 0.2}, {2.2, 0.9},
                              {1.6, 3.7}, {3.4, 1.7}, {4.0, 0.3}, {2.9, 4.0}};
  for (const auto& part : parts)
    for (int k = 1; k <= 10; ++k) {
      const Eigen::VectorXd rho = Eigen::Vector3d(part[0], part[1], k);
      const double value = evaluator.evaluate(rho, false).objective;
      if (value < least) least = value, best = rho;
    }
  EXPECT_EQ(result.best.rho, best);
  EXPECT_NEAR(result.best.objective, least, 1e-6 * least);
  EXPECT_TRUE(result.choice.is_complete);
  EXPECT_LT(result.choice.searched, 60);
  // The nearest part to the best numbers between, with the nearest whole number, is not the best.
  std::string between = servo(
      "mass: {initial: 1.0, lower: 0.6, upper: 4.0}, k: {initial: 3.0, "
      "lower: 1.0, upper: 10.0}");
  between.replace(between.find("tune: false"), 11, "lower: 0.1, upper: 4.0");
  const Problem free = cart(between);
  const OptimizationResult relaxed = optimize(free);
  ASSERT_TRUE(relaxed.status.ok()) << relaxed.status.cause;
  EXPECT_LT(relaxed.best.objective, least);
  ASSERT_EQ(free.tuned_names(), (std::vector<std::string>{"damping", "mass", "k"}));
  Eigen::VectorXd rounded = best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& part : parts) {
    const double away = std::max(std::abs(part[0] - relaxed.best.rho[1]) / 3.4,
                                 std::abs(part[1] - relaxed.best.rho[0]) / 3.9);
    if (away >= nearest) continue;
    nearest = away;
    rounded = Eigen::Vector3d(part[0], part[1], std::round(relaxed.best.rho[2]));
  }
  EXPECT_GT(evaluator.evaluate(rounded, false).objective, 1.01 * least);
}

TEST(ChoiceSearch, FewCombinationsAreAllSearched) {
  const OptimizationResult result = optimize(
      cart(squares("x: {initial: 1, choice: [1, 7, 4]}, y: {initial: 1.0}", {"x - 4.9", "y - x"})));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.best.rho[0], 4.0);
  EXPECT_NEAR(result.best.rho[1], 4.0, 1e-6);
  EXPECT_EQ(result.termination, "all_combinations_searched");
  EXPECT_EQ(result.choice.searched, 3);
  EXPECT_EQ(result.choice.relaxations, 0);
}

TEST(ChoiceSearch, WhatIsChosenAloneHasNoSlope) {
  const OptimizationResult result =
      optimize(cart(squares("x: {initial: 7, choice: [1, 7, 4]}", {"x - 4.9"})));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.best.rho[0], 4.0);
  EXPECT_TRUE(std::isnan(result.optimality.stationarity));
  EXPECT_EQ(result.cost.evaluations, 3);
}

TEST(ChoiceSearch, CombinationsThatViolateConstraintsAreNotTaken) {
  const OptimizationResult result = optimize(
      cart(squares("x: {initial: 7, choice: [1, 7, 4]}, y: {initial: 1.0}", {"x - 4.9", "y"}) +
           "constraints: [\"x >= 4.5\"]\n"));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_EQ(result.best.rho[0], 7.0);
  const OptimizationResult none = optimize(
      cart(squares("x: {initial: 7, choice: [1, 7, 4]}, y: {initial: 1.0}", {"x - 4.9", "y"}) +
           "constraints: [\"x >= 4.5\", \"x + 0*y <= 5\"]\n"));
  EXPECT_EQ(none.status.code, StatusCode::kInfeasible);
}

TEST(ChoiceSearch, ACancelledSearchKeepsTheBestCombination) {
  const Problem problem = cart(squares(kValley, kResiduals));
  std::vector<double> real;
  const OptimizationResult result = optimize(problem, [&](const Trial& trial) {
    EXPECT_TRUE(real.empty() || trial.best_objective <= real.back());
    real.push_back(trial.best_objective);
    return trial.evaluation < 40;
  });
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
  EXPECT_FALSE(result.choice.is_complete);
  EXPECT_EQ(result.best.objective, real.back()) << "no relaxation counts as the best";
  EXPECT_EQ(result.best.rho[0], std::round(result.best.rho[0]));
  EXPECT_EQ(result.best.rho[1], std::round(result.best.rho[1]));
}

TEST(ChoiceSearch, ATableHasRowsWithNames) {
  const OptimizationResult result = optimize(
      cart(servo("k: {initial: 3.0, lower: 1.0, upper: 10.0}, motor: {choice: motors.csv}")));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.choice.chosen.size(), 1u);
  EXPECT_EQ(result.choice.chosen[0].first, "motor");
  EXPECT_TRUE(result.choice.chosen[0].second == "small" ||
              result.choice.chosen[0].second == "large");
  EXPECT_EQ(result.choice.searched, 2);
}

TEST(ChoiceSearch, ListsThatAreNoneAreRefused) {
  const std::vector<std::string> bad{"x: {initial: 1, choice: [1]}",
                                     "x: {initial: 1, choice: [1, 1]}",
                                     "x: {initial: 2, choice: [1, 3]}",
                                     "x: {initial: 1, choice: [1, 3], lower: 0}",
                                     "x: {initial: 1, choice: [1, 3], integer: [1, 3]}",
                                     "x: {initial: 1, integer: [3, 1]}",
                                     "x: {initial: 1, integer: [1, 2, 3]}",
                                     "x: {initial: 1, integer: [1.5, 3]}",
                                     "x: {initial: 1}, part: {choice: [{x: 1}, {x: 2}]}",
                                     "part: {choice: [{nothing: 1}, {nothing: 2}]}",
                                     "mass: {choice: [{mass: 1}, {mass: 2}]}",
                                     "part: {choice: [{mass: 1}, {mass: 2, part: a}]}",
                                     "part: {choice: [{mass: 1}, 2]}",
                                     "x: {initial: 1, choice: []}"};
  for (const std::string& parameters : bad)
    EXPECT_THROW(cart(squares(parameters, {"1.0"})), InputError) << parameters;
  EXPECT_THROW(
      cart(squares("x: {initial: 1, choice: [1, 3]}", {"x"}) + "multistart: {starts: 2}\n"),
      InputError);
}

}  // namespace
}  // namespace codesign
