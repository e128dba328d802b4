// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Points whose slope is small and that are no optima, optima that look flat, and designs outside
// their constraints: objectives of known minima.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "description/study.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_results.h"
#include "problem/load_problem.h"

namespace codesign::false_optima {
namespace {

/// A block that nothing moves. @param parameters their elements. @param study without duration.
OptimizationResult tune(const std::string& parameters, const std::string& study,
                        const std::string& joint = "") {
  const SourceText urdf{"block.urdf",
                        R"(<robot name="block" xmlns:codesign="urn:mechanism_codesign">
)" + parameters + R"(
  <link name="ground"/>
  <link name="block"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="block"/><axis xyz="0 0 1"/>
    <limit lower="-1000" upper="1000" effort="1e6" velocity="1e6"/>)" +
                            joint + R"(</joint>
</robot>)"};
  const std::string motion = joint.empty() ? "duration: 0.01\ngravity: [0, 0, 0]\n" : "";
  return optimize(load_problem(urdf, {}, {"block.yaml", motion + study}));
}

std::string parameter(const std::string& name, double value, const std::string& bounds) {
  return "<codesign:parameter name=\"" + name + "\" value=\"" + std::to_string(value) + "\" " +
         bounds + "/>";
}

/// Parameters a and b within 10 of zero.
std::string a_and_b(double a, double b) {
  const std::string bounds = "lower=\"-10\" upper=\"10\"";
  return parameter("a", a, bounds) + parameter("b", b, bounds);
}

/// The sum of the squares of expressions.
std::string squares(const std::vector<std::string>& residuals, const std::string& more = "") {
  std::string terms;
  for (const std::string& residual : residuals)
    terms += "    - {signal: \"${" + residual + " + 0*slide/position}\"}\n";
  return "parameters: {a: {}, b: {}}\nobjective:\n  terminal:\n" + terms + more;
}

bool has_warning(const OptimizationResult& result, const std::string& code,
                 const std::string& part = "") {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [&](const Warning& warning) {
    return warning.code == code && warning.message.find(part) != std::string::npos;
  });
}

// At a = b = 0 the gradient of (a b - 1)^2 is zero, and so is the Jacobian of its residual.
TEST(FalseOptima, ASearchLeavesASaddle) {
  for (const auto& [a, b] : {std::pair(3.0, -1.0), std::pair(-4.0, 5.0), std::pair(7.0, -0.5)}) {
    const OptimizationResult result = tune(a_and_b(a, b), squares({"a*b-1"}));
    ASSERT_TRUE(result.status.ok()) << result.status.cause;
    EXPECT_LT(result.best.objective, 1e-10) << a << ", " << b;
    EXPECT_EQ(result.optimality.flat_directions.cols(), 1) << "only the product counts";
  }
}

TEST(FalseOptima, ASearchLeavesAStartWithoutSlope) {
  for (const char* algorithm : {"auto", "slsqp", "lbfgs"}) {
    const OptimizationResult result =
        tune(a_and_b(0.0, -1.0),
             squares({"a^2-1", "b-2"}, std::string("optimizer: {algorithm: ") + algorithm + "}\n"));
    EXPECT_LT(result.best.objective, 1e-8) << algorithm;
    EXPECT_FALSE(has_warning(result, "parameter_without_influence")) << algorithm;
  }
  const OptimizationResult step =
      tune(a_and_b(3.2, -1.0), squares({"floor(a)-1", "b-2"}, "optimizer: {algorithm: cobyla}\n"));
  EXPECT_FALSE(has_warning(step, "parameter_without_influence")) << "its derivative is zero";
  EXPECT_TRUE(has_warning(tune(a_and_b(1.0, 1.0), squares({"a-2"})), "parameter_without_influence",
                          "derivative"));
}

TEST(FalseOptima, OneMinimumIsNoFlatDirection) {
  const std::string slsqp = "optimizer: {algorithm: slsqp, max_evaluations: 2000}\n";
  EXPECT_EQ(tune(a_and_b(3.0, -1.0), squares({"(a-1)^2", "b-2"}, slsqp))
                .optimality.flat_directions.cols(),
            0)
      << "a minimum of the fourth order";
  const OptimizationResult freudenstein =
      tune(parameter("a", 0.5, "lower=\"-20\" upper=\"20\"") +
               parameter("b", -2.0, "lower=\"-20\" upper=\"20\""),
           squares({"-13+a+((5-b)*b-2)*b", "-29+a+((b+1)*b-14)*b"}));
  EXPECT_NEAR(freudenstein.best.objective, 48.98425, 1e-4);
  EXPECT_EQ(freudenstein.optimality.flat_directions.cols(), 0)
      << "where the Jacobian has one row's rank";
  const std::string positive = "lower=\"0\"";
  const OptimizationResult small =
      tune(parameter("a", 1e-6, positive) + parameter("b", 1.0, positive), squares({"a-1", "b-2"}));
  EXPECT_NEAR(small.best.rho[0], 1.0, 1e-6);
  EXPECT_EQ(small.optimality.flat_directions.cols(), 0) << "a start of 1e-6 is no range";
  const OptimizationResult arrival =
      tune(a_and_b(0.2, 0.4),
           squares({"a-1"},
                   "  arrival: [{signal: \"${t - 0.001*(b-2)^2 + 0*slide/position}\", band: "
                   "[0.003, 100]}]\n"));
  EXPECT_EQ(arrival.optimality.flat_directions.cols(), 0) << "b changes a time alone";
}

constexpr const char* kSpring =
    "<codesign:torsion_spring stiffness=\"1\" codesign:stiffness=\"${k}\"/>";

// The spring that holds a block of 1 kg 0.1 mm below, from a stiffness of 1 N/m on: a change by the
// start is worth 2e-5 of the objective.
TEST(FalseOptima, AStartFarBelowTheOptimumIsNone) {
  for (const char* algorithm : {"auto", "slsqp", "mma", "lbfgs"}) {
    const OptimizationResult result =
        tune(parameter("k", 1.0, "lower=\"0\""),
             std::string("positions: {slide: [-0.0001, -0.0001]}\nhold: true\nparameters: {k: {}}\n"
                         "objective: {sum: [{signal: slide/effort}]}\noptimizer: {algorithm: ") +
                 algorithm + "}\n",
             kSpring);
    EXPECT_NEAR(result.best.rho[0], 98100.0, 100.0) << algorithm;
  }
}

TEST(FalseOptima, AFarOptimumIsFoundOrItsStopIsNoSuccess) {
  for (const char* algorithm : {"auto", "slsqp", "mma", "ccsaq", "cobyla", "bobyqa"}) {
    const OptimizationResult result =
        tune(parameter("a", 0.0, "") + parameter("b", 1.0, ""),
             squares({"a-1e6", "b-2"}, std::string("optimizer: {algorithm: ") + algorithm + "}\n"));
    EXPECT_TRUE(std::abs(result.best.rho[0] - 1e6) < 1e3 ||
                !(result.optimality.stationarity <= 1e-3))
        << algorithm << " " << result.best.rho.transpose();
    EXPECT_EQ(
        result.optimality.stationarity > 1e-3,
        result.termination == "stopped_early" || result.termination == "max_evaluations_reached")
        << algorithm << " " << result.termination;
  }
}

// Zero as a start tells nothing of sizes: at the start the second residual is 2e6 times as steep.
TEST(FalseOptima, StartsOfZeroHaveNoSize) {
  for (const char* algorithm : {"auto", "slsqp", "lbfgs", "bobyqa", "cobyla", "mma"})
    for (const auto& [large, small] :
         {std::pair(1e9, 1e-6), std::pair(1e6, 1e-9), std::pair(1e11, 1e-3)}) {
      const OptimizationResult result = tune(
          parameter("a", 0.0, "") + parameter("b", 0.0, ""),
          squares(
              {"a/" + std::to_string(large) + "-2.3", "b*" + std::to_string(1.0 / small) + "-2"},
              std::string("optimizer: {algorithm: ") + algorithm + "}\n"));
      EXPECT_TRUE(result.best.objective < 1e-3 || !(result.optimality.stationarity <= 1e-3))
          << algorithm << " " << large << ": stationary to " << result.optimality.stationarity
          << " at " << result.best.objective;
      EXPECT_TRUE(result.best.objective < 1e-3 || result.termination == "stopped_early" ||
                  result.termination == "max_evaluations_reached")
          << algorithm << " " << large << " " << result.termination;
    }
}

// R has entries of 1e5 and 13, whose squares differ by less than 1e-8: no flat direction.
TEST(FalseOptima, ASoftDirectionBesideAStiffOneIsNotFlat) {
  for (const char* algorithm : {"auto", "slsqp"}) {
    const OptimizationResult result = tune(
        a_and_b(3.0, -1.0),
        squares({"1e6*(a+b-1.5)", "a-1"}, std::string("optimizer: {max_evaluations: 1000, "
                                                      "relative_tolerance: 1e-12, algorithm: ") +
                                              algorithm + "}\n"));
    EXPECT_EQ(result.optimality.flat_directions.cols(), 0) << algorithm;
  }
}

// What is printed are designs that are as good.
TEST(FalseOptima, ThePointsOfAFlatDirectionAreAsGood) {
  for (const char* residual : {"a*b-1", "a-b*b-1", "exp(a)*b-2", "a+b-1"}) {
    const OptimizationResult result = tune(a_and_b(1.7, 1.2), squares({residual}));
    ASSERT_EQ(result.optimality.flat_points.cols(), 1) << residual;
    const double a = result.optimality.flat_points(0, 0), b = result.optimality.flat_points(1, 0);
    const double left = residual == std::string("a*b-1")        ? a * b - 1.0
                        : residual == std::string("a-b*b-1")    ? a - b * b - 1.0
                        : residual == std::string("exp(a)*b-2") ? std::exp(a) * b - 2.0
                                                                : a + b - 1.0;
    EXPECT_LT(left * left, 1e-6) << residual;
    EXPECT_GT((result.optimality.flat_points.col(0) - result.best.rho).norm(), 0.01) << residual;
    EXPECT_TRUE(has_warning(result, "flat_direction", "such as a ")) << residual;
  }
}

// A staircase has the slope zero wherever a search stops on it.
TEST(FalseOptima, AStaircaseIsNotCalledStationary) {
  const std::vector<std::string> stairs{"floor(a)-7",
                                        "ceil(a)-7",
                                        "sign(a-6.5)-2",
                                        "floor(a+0.5)-7",
                                        "(a > 6.5 ? 1 : 3)-1.5",
                                        "(a < 2 ? 5 : (a < 7 ? 3 : 1))",
                                        "0.01*a+floor(a)-7",
                                        "(a > 6.5 and a < 8 ? 0 : 2) + 0.001*a"};
  for (const std::string& stair : stairs)
    for (const char* algorithm : {"auto", "slsqp", "lbfgs", "bobyqa", "cobyla"}) {
      const OptimizationResult result =
          tune(a_and_b(3.2, -1.0),
               squares({stair, "b-2"}, std::string("optimizer: {algorithm: ") + algorithm + "}\n"));
      if (result.best.objective == 0.0) continue;
      EXPECT_TRUE(std::isnan(result.optimality.stationarity)) << stair << " " << algorithm;
      EXPECT_TRUE(result.termination == "stopped_early" ||
                  result.termination == "max_evaluations_reached")
          << stair << " " << algorithm << " " << result.termination;
      EXPECT_TRUE(has_warning(result, "objective_jumps", "\"a\"")) << stair << " " << algorithm;
      EXPECT_EQ(stop_sentence(result).find("stationary"), std::string::npos)
          << stop_sentence(result);
    }
}

TEST(FalseOptima, KinksAndBranchesThatMeetAreNoStaircase) {
  for (const char* smooth : {"abs(a)-0.5", "max(a, 0.2)-0.5", "(a > 0 ? a : 2*a)-0.5", "min(a,4)-1",
                             "(a > 20 ? 1 : 0)+a-0.5"}) {
    const OptimizationResult result = tune(a_and_b(3.2, -1.0), squares({smooth, "b-2"}));
    EXPECT_TRUE(result.optimality.unjudged.empty()) << smooth << result.optimality.unjudged;
    EXPECT_NE(result.termination, "stopped_early") << smooth;
  }
  EXPECT_TRUE(tune(a_and_b(3.2, -1.0),
                   "parameters: {b: {}}\nobjective: {terminal: [{signal: \"${floor(a) + b - 2 + "
                   "0*slide/position}\"}]}\n")
                  .optimality.unjudged.empty())
      << "a is not tuned";
}

TEST(FalseOptima, AnUnboundedObjectiveIsTold) {
  std::string study =
      squares({"a", "b-1"}, "optimizer: {algorithm: bobyqa, max_evaluations: 2000}\n");
  study.insert(study.find("\"}") + 1, ", weight: -1");
  const OptimizationResult result = tune(parameter("a", 0.3, "") + parameter("b", 0.5, ""), study);
  EXPECT_LT(result.best.objective, -1e6);
  EXPECT_EQ(result.termination, "stopped_early");
  EXPECT_TRUE(has_warning(result, "not_stationary", "falls without end along a"));
}

// From an optimum that rounding keeps from zero, there is nothing to gain, and no slope to fall.
TEST(FalseOptima, AnOptimumStaysOne) {
  for (const char* algorithm : {"auto", "slsqp", "lbfgs"}) {
    const OptimizationResult result =
        tune(a_and_b(0.7 + 1e-11, 0.1 - 1e-11),
             squares({"sin(a)*b - sin(0.7)*0.1", "a*a+3*b-0.79", "exp(b)*a-exp(0.1)*0.7"},
                     std::string("optimizer: {algorithm: ") + algorithm + "}\n"));
    EXPECT_NE(result.termination, "stopped_early") << algorithm;
    EXPECT_LE(result.optimality.stationarity, 1e-3) << algorithm;
  }
}

TEST(FalseOptima, ADesignOutsideASmallConstraintIsNone) {
  const std::string residuals = squares({"(a-9e-8)*1e8", "b-.3"}, "constraints: [\"a <= 5e-8\"]\n");
  const OptimizationResult result =
      tune("<codesign:parameter name=\"a\" value=\"2e-8\" lower=\"0\" upper=\"1e-6\"/>" +
               parameter("b", 0.5, "lower=\"0\" upper=\"1\""),
           residuals);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.rho[0], 5e-8, 1e-12);
}

TEST(FalseOptima, BoundsThatContradictEachOtherAreNotMetFromFarAway) {
  const OptimizationResult result =
      tune(parameter("a", 1e4, "lower=\"-1e5\" upper=\"1e5\"") +
               parameter("b", 0.0, "lower=\"-10\" upper=\"10\""),
           squares({"b-1"},
                   "path: [{signal: \"${a + 0*slide/position}\", at_most: 0.05}, "
                   "{signal: \"${a + 0*slide/position}\", at_least: 0.1}]\n"));
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible) << result.best.rho.transpose();
}

TEST(FalseOptima, AKinkIsNoFlatDirection) {
  const OptimizationResult result =
      tune(a_and_b(3.2, -1.0), squares({"sqrt(abs(a-1)+1e-300)", "sqrt(abs(b+a-2)+1e-300)"}));
  EXPECT_NEAR(result.best.rho[0], 1.0, 1e-6);
  EXPECT_EQ(result.optimality.flat_directions.cols(), 0);
}

TEST(FalseOptima, ASlopeThatIsNotFiniteIsSaid) {
  OptimizationResult result;
  result.termination = "stopped_early";
  const Study study;
  const Warnings warnings = search_warnings(study, study.optimizer, result);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].message.find("not finite; no algorithm gains"), std::string::npos)
      << warnings[0].message;
}

TEST(FalseOptima, ABoundWithoutRangeIsWidenedByAShareOfItsValue) {
  const OptimizationResult result =
      tune(parameter("a", 300.0, "upper=\"1000\"") + parameter("b", 1.5, "lower=\"1.2\""),
           squares({"a/1000.0-2", "b-1"}));
  EXPECT_NEAR(result.best.rho[0], 1000.0, 1e-6);
  EXPECT_NEAR(result.optimality.bound_multipliers[0], -2.0, 1e-6) << "2 (2 - a/1000) a/1000";
  EXPECT_NEAR(result.optimality.bound_multipliers[1], 0.4 * 1.5, 1e-6);
  EXPECT_TRUE(has_warning(result, "parameter_on_bound", "widen the bound by 10 would"));
}

}  // namespace
}  // namespace codesign::false_optima
