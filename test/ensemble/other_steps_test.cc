// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients that share their steps' blind spots, handed to the check: it refutes them, whatever the
// package itself computes today, and confirms the right ones.
#include "ensemble/other_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ensemble/ensemble_fixture.h"
#include "ensemble/other_steps_fixture.h"
#include "paths.h"

namespace codesign {
namespace {

IndependentCheck check_of(const Problem& problem, double gradient, double runs_explicit = 1.0,
                          const std::atomic<bool>* cancel = nullptr) {
  const Ensemble ensemble(problem);
  ClaimedGradient claim;
  claim.gradient = Eigen::VectorXd::Constant(problem.start().size(), gradient);
  claim.by_value = Eigen::VectorXd::Ones(1);
  const Evaluation own = ensemble.evaluate(problem.start(), false).total;
  EXPECT_TRUE(own.status.ok()) << own.status.cause;
  claim.objective = own.objective;
  claim.statistics = own.statistics;
  claim.statistics.explicit_steps =
      static_cast<std::int64_t>(runs_explicit * static_cast<double>(own.statistics.steps));
  return check_other_steps(ensemble, problem.start(), claim, true, cancel);
}

struct Trap {
  const char* name;
  Problem problem;
  double wrong, right, tolerance;  ///< the last one relative
};

/// What steps do not see: a rest from which explicit steps of any length are accepted, a switching
/// time, a threshold, dry friction of an own law, a pulse by position.
std::vector<Trap> traps() {
  const double omega = std::sqrt(1.0 - 0.05 * 0.05),
               swing = std::exp(-2.5) *
                       (std::cos(50.0 * omega) + 0.05 / omega * std::sin(50.0 * omega));
  return {
      {"rest",
       load_problem(
           {"slide.urdf",
            R"(<robot name="o" xmlns:codesign="urn:mechanism_codesign"><link name="ground"/><link name="body">
<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="x" type="prismatic"><parent link="ground"/><child link="body"/><axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="9" velocity="9"/>
<codesign:torsion_spring stiffness="1" damping="0.1"/></joint></robot>)"},
           {},
           {"rest.yaml",
            "duration: 50\ninitial_state: {x: {position: \"${x0}\"}}\nparameters: {x0: {initial: "
            "0, lower: -2, upper: 2}}\nobjective: {terminal: [{signal: x/position, reference: "
            "-1}]}\n"}),
       -5.3e9, 2.0 * swing, 1e-5},
      {"switch", tuned_switch(), 0.0, -6.912, 1e-3},
      // x = 1 until 0.7; then -0.5 (2 - 0.7)^2 / 2 less: psi' = 2 x(2) 0.5 (2 - 0.7) = 2.05075.
      {"threshold",
       slide("duration: 2.0\nloads: [{joint: x, effort: \"${x/position > xs ? -0.5 : 0}\"}]\n"
             "parameters: {xs: {initial: 0.7, lower: 0.1, upper: 1.5}}\n"
             "objective: {terminal: [{signal: x/position, reference: 0.0}]}\n",
             "1"),
       0.0, 2.05075, 1e-3},
      {"own friction",
       slide("duration: 2\nloads: [{joint: x, effort: \"${-f*sign(x/velocity)}\"}, {joint: x, "
             "effort: \"${2*sin(4*t)}\"}]\nparameters: {f: {initial: 0.5, lower: 0, upper: 3}}\n"
             "objective: {terminal: [{signal: x/position}]}\n",
             "0.2"),
       -1.598233, -1.1486306, 1e-3},
  };
}

TEST(OtherSteps, RefuteGradientsThatDoNotSeeWhatTheirStepsPassOver) {
  for (const Trap& trap : traps()) {
    const IndependentCheck check = check_of(trap.problem, trap.wrong);
    ASSERT_TRUE(check.is_known()) << trap.name << ": " << check.status.cause;
    EXPECT_NEAR(check.derivative, trap.right, trap.tolerance * std::abs(trap.right)) << trap.name;
    EXPECT_LT(check.error, 1e-2 * std::abs(trap.right)) << trap.name;
    EXPECT_LT(std::abs(check.derivative - trap.right), check.error + 1e-7) << trap.name;
    EXPECT_TRUE(check.disagrees()) << trap.name;
    EXPECT_LE(check.evaluations, kMostEvaluations);
    EXPECT_FALSE(check_of(trap.problem, trap.right).disagrees()) << trap.name;
  }
}

// A pulse of 0.03 s by the angle: steps of a tenth of a second pass it over, and the objective is
// another one, too.
TEST(OtherSteps, ResolvePulsesByPosition) {
  const Problem problem = slide(
      "duration: 1.2\nloads: [{joint: x, effort: \"${-100*exp(-5000*(x/position - 4)^2)}\"}]\n"
      "parameters: {m: {}}\nobjective: {terminal: [{signal: x/velocity}]}\n"
      "solver: {maximum_step: 0.3, initial_step: 0.3}\n",
      "10");
  // m v^2 / 2 falls by the integral of the force over the way, 100 sqrt(pi / 5000).
  const double work = 100.0 * std::sqrt(std::acos(-1.0) / 5000.0), right = 2.0 * work;
  const IndependentCheck check = check_of(problem, 0.0);
  ASSERT_TRUE(check.is_known()) << check.status.cause;
  EXPECT_NEAR(check.objective, 100.0 - 2.0 * work, 1e-5);
  EXPECT_NEAR(check.derivative, right, 1e-4 * right);
  EXPECT_TRUE(check.disagrees());
}

TEST(OtherSteps, TakeTheOtherClassOfMethodAndEndInTime) {
  const Problem problem = tuned_switch();
  EXPECT_EQ(check_of(problem, 0.0, 1.0).method, "rodas5p");
  EXPECT_EQ(check_of(problem, 0.0, 0.0).method, "dopri5");
  // A damper of 1e6 N s/m: far more explicit steps than the check may take.
  const Problem stiff = slide(
      "duration: 2.0\nloads: [{joint: x, effort: \"${-1e6*(x/velocity - 1) + f}\"}]\n"
      "parameters: {f: {initial: 10, lower: 0, upper: 20}}\n"
      "objective: {terminal: [{signal: x/position}]}\n");
  const IndependentCheck check = check_of(stiff, 2.0 * 2.0 * 2e-6, 0.0);
  ASSERT_TRUE(check.is_known()) << check.status.cause;
  EXPECT_EQ(check.method, "rodas4p2");
  EXPECT_FALSE(check.disagrees());
}

// |f| has no derivative at 0: the differences are 0, and their error is the slope.
TEST(OtherSteps, KnowTheirErrorAtAKink) {
  const Problem problem = slide(
      "duration: 1.0\nloads: [{joint: x, effort: \"${abs(f)}\"}]\n"
      "parameters: {f: {initial: 0, lower: -1, upper: 1}}\n"
      "objective: {terminal: [{signal: x/position, reference: -1}]}\n");
  const IndependentCheck check = check_of(problem, 1.0);
  ASSERT_TRUE(check.is_known()) << check.status.cause;
  EXPECT_GT(check.error, 0.9) << "the slopes of both sides are -1 and 1";
  EXPECT_FALSE(check.disagrees());
}

TEST(OtherSteps, AreTakenIntoTheInteriorFromABound) {
  const Problem problem = slide(
      "duration: 1.0\nloads: [{joint: x, effort: \"${sqrt(f)}\"}]\n"
      "parameters: {f: {initial: 1, lower: 1, upper: 1.5}}\n"
      "objective: {terminal: [{signal: x/position}]}\n");
  // x(1) = sqrt(f) / 2: psi = f / 4.
  const IndependentCheck check = check_of(problem, 0.25);
  ASSERT_TRUE(check.is_known()) << check.status.cause;
  EXPECT_NEAR(check.derivative, 0.25, 1e-6);
  EXPECT_GT(check.direction[0], 0.0);
  EXPECT_FALSE(check.disagrees());
  EXPECT_TRUE(check_of(problem, 0.3).disagrees());
}

TEST(OtherSteps, ConfirmGradientsOfAllMeasuresWithAnyNumberOfWorkers) {
  for (const char* measure : {"mean", "worst", "cvar, level: 0.6", "mean_plus_deviation"}) {
    const auto check_with = [measure](const std::string& engine) {
      const Problem problem =
          block("uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 4, measure: " +
                std::string(measure) + "}\nengine: " + engine + "\n");
      const Ensemble ensemble(problem);
      GradientCheck check = check_along(ensemble, problem.start(), CheckMethod::kComplexStep);
      check_other_steps(ensemble, problem.start(), nullptr, &check);
      return check;
    };
    const GradientCheck one = check_with("{type: serial}"),
                        two = check_with("{type: threads, workers: 2}");
    ASSERT_TRUE(one.independent.is_known()) << one.independent.status.cause;
    EXPECT_FALSE(one.independent.disagrees()) << measure;
    EXPECT_LT(one.independent.error, 0.05 * one.independent.size) << measure;
    EXPECT_EQ(one.independent.derivative, two.independent.derivative);
    EXPECT_EQ(one.independent.error, two.independent.error);
    EXPECT_TRUE(one.evaluation.warnings.empty());
  }
}

TEST(OtherSteps, AreCancelled) {
  const std::atomic<bool> cancel{true};
  const IndependentCheck check = check_of(tuned_switch(), 0.0, 1.0, &cancel);
  EXPECT_FALSE(check.is_known());
  EXPECT_FALSE(check.disagrees());
  EXPECT_EQ(check.status.code, StatusCode::kCancelled);
}

TEST(OtherSteps, WarnWithBothNumbers) {
  const Problem problem = tuned_switch();
  const Ensemble ensemble(problem);
  GradientCheck check;
  check.evaluation = ensemble.evaluate(problem.start(), false).total;
  check.evaluation.gradient = Eigen::VectorXd::Zero(1);
  check_other_steps(ensemble, problem.start(), nullptr, &check);
  ASSERT_EQ(check.evaluation.warnings.size(), 1u);
  EXPECT_EQ(check.evaluation.warnings[0].code, "gradient_disagrees");
  EXPECT_NE(check.evaluation.warnings[0].message.find("-6.91"), std::string::npos)
      << check.evaluation.warnings[0].message;
}

// A time in a band has no complex step; the differences through other steps have their error.
TEST(OtherSteps, TellTheirErrorAlsoWithTimesInBands) {
  const Problem problem = slide(
      "duration: 4.0\nparameters: {m: {}}\nloads: [{joint: x, effort: \"${-x/position}\"}]\n"
      "objective: {dwell: [{signal: x/position, band: [0.5, 2]}]}\n",
      "1");
  const Ensemble ensemble(problem);
  GradientCheck check = check_along(ensemble, problem.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  check_other_steps(ensemble, problem.start(), nullptr, &check);
  // x = sqrt(m) sin(t / sqrt(m)) is above 1/2 for sqrt(m) (pi - 2 asin(1 / (2 sqrt(m)))).
  const double half = 0.5 / std::sqrt(0.75),
               right = 0.5 * (std::acos(-1.0) - 2.0 * std::asin(0.5)) + half;
  ASSERT_TRUE(check.independent.is_known()) << check.independent.status.cause;
  EXPECT_NEAR(check.independent.derivative, right, 1e-5);
  EXPECT_GT(check.independent.error, 0.0);
  EXPECT_LT(check.independent.error, 1e-3 * right);
  EXPECT_FALSE(check.independent.disagrees());
}

TEST(OtherSteps, CountTheWorstForScenariosThatFailed) {
  Eigen::VectorXd by_value = Eigen::Vector4d(0.1, 0.2, 0.3, 0.4);
  count_worst_for_failed({1, 3}, Eigen::Vector4d(5.0, 9.0, 7.0, 9.0), &by_value);
  EXPECT_LT((by_value - Eigen::Vector4d(0.1, 0.0, 0.9, 0.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace codesign
