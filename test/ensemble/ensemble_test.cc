// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/ensemble.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "description/study.h"
#include "edited_text.h"
#include "ensemble/ensemble_fixture.h"
#include "ensemble/other_steps.h"
#include "integration/mechanisms.h"
#include "mechanism_codesign/optimization.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

const char* const kUncertain = "uncertain: {mu: {uniform: [0.2, 0.4]}}\n";

TEST(Ensemble, OneRunIsTheEvaluationBitForBit) {
  for (const char* text :
       {"", "uncertain: {mu: {uniform: [0.2, 0.4]}}\nrobust: {samples: 1, measure: worst}\n",
        "runs: {only: {}}\n"}) {
    const Problem problem = block(text);
    const Evaluation one = Evaluator(problem).evaluate(problem.start(), true);
    const EnsembleEvaluation all = Ensemble(problem).evaluate(problem.start(), true);
    EXPECT_EQ(all.total.objective, one.objective);
    EXPECT_EQ(all.total.gradient, one.gradient);
    EXPECT_EQ(all.total.statistics.steps, one.statistics.steps);
  }
}

TEST(Ensemble, TheMeanWeighsTheRuns) {
  const Problem problem =
      block("runs: {light: {set: {mass: 1.0}}, heavy: {set: {mass: 4.0}, weight: 3.0}}\n");
  const EnsembleEvaluation all = Ensemble(problem).evaluate(problem.start(), true);
  std::vector<double> light = problem.parameters(), heavy = light;
  light[1] = 1.0;
  heavy[1] = 4.0;
  Evaluator evaluator(problem);
  const Evaluation a = evaluator.evaluate_design(light, true),
                   b = evaluator.evaluate_design(heavy, true);
  EXPECT_DOUBLE_EQ(all.total.objective, 0.25 * a.objective + 0.75 * b.objective);
  EXPECT_LT((all.total.gradient - (0.25 * a.gradient + 0.75 * b.gradient)).norm(),
            1e-14 * b.gradient.norm());
  EXPECT_EQ(all.total.statistics.steps, a.statistics.steps + b.statistics.steps);
}

/// An arm on an elastic gear that loses torque, turned by a spring-like controller.
Problem geared_arm(const std::string& ensemble) {
  const auto parameter = [](const char* name, const char* value) {
    return std::string("<codesign:parameter name='") + name + "' value='" + value + "'/>";
  };
  return load_problem(
      {"arm.urdf",
       robot(
           parameter("eta", "0.8") + parameter("k", "300") + parameter("rub", "0.02") +
           parameter("mass", "1") +
           replaced_all(bar("bar"), "<mass value='1'", "<mass value='1' codesign:value='${mass}'") +
           hinge("hinge", "ground", "bar", "0 0 0",
                 "<codesign:actuator gear_ratio='20' rotor_inertia='1e-3' efficiency='0.8' "
                 "codesign:efficiency='${eta}' stiffness='300' codesign:stiffness='${k}' "
                 "coulomb='0.02' codesign:coulomb='${rub}' transition_velocity='0.1'/>"))},
      {},
      {"arm.yaml",
       "duration: 0.5\ninitial_state: {hinge: {position: 0.8}}\nparameters: {p: {initial: 15.0}, "
       "mass: {tune: true}}\ncontrollers: {hold: {type: pid, input: hinge/position, setpoint: 0.0, "
       "output: "
       "hinge, gains: {p: \"${p}\"}}}\nobjective: {integral: [{signal: hinge/velocity}, {signal: "
       "hinge/gear_loss}]}\n" +
           ensemble});
}

TEST(Ensemble, NumbersOfGearsAreUncertainLikeAllOthers) {
  const Problem problem = geared_arm(
      "uncertain: {eta: {choice: [0.7, 0.9]}, k: {uniform: [200, 400]}, rub: {normal: [0.02, "
      "0.002]}}\nrobust: {samples: 4, measure: mean}\n");
  const Ensemble ensemble(problem);
  const EnsembleEvaluation all = ensemble.evaluate(problem.start(), true);
  ASSERT_TRUE(all.total.status.ok()) << all.total.status.cause;
  ASSERT_EQ(ensemble.scenarios().size(), 4u);
  Evaluator by_hand(problem);
  double sum = 0.0;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(2);
  std::vector<std::set<double>> numbers(3);
  for (const Scenario& scenario : ensemble.scenarios()) {
    const std::vector<double> design = scenario.parameters(problem.start());
    for (std::size_t k = 0; k < 3; ++k) numbers[k].insert(design[k]);
    const Evaluation one = by_hand.evaluate_design(design, true);
    ASSERT_TRUE(one.status.ok()) << one.status.cause;
    sum += 0.25 * one.objective;
    gradient += 0.25 * one.gradient;
  }
  EXPECT_EQ(numbers[0].size(), 2u);
  EXPECT_EQ(numbers[1].size(), 4u);
  EXPECT_EQ(numbers[2].size(), 4u);
  EXPECT_NEAR(all.total.objective, sum, 1e-14 * sum);
  EXPECT_LT((all.total.gradient - gradient).norm(), 1e-13 * gradient.norm());
  const Evaluation nominal = by_hand.evaluate(problem.start(), false);
  EXPECT_GT(std::abs(nominal.objective - sum), 1e-6 * sum) << "the numbers count";
  const GradientCheck check = check_gradient(ensemble, problem.start(), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_LT(check.largest_relative_difference, 1e-8);
}

TEST(Ensemble, GradientsOfAllMeasuresAgreeWithTheComplexStep) {
  for (const char* measure :
       {"mean", "worst", "cvar, level: 0.6", "mean_plus_deviation, factor: 2.0"}) {
    const Problem problem =
        block(std::string(kUncertain) + "robust: {samples: 6, measure: " + measure + "}\n");
    Ensemble ensemble(problem);
    const GradientCheck check =
        check_gradient(ensemble, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_GT(check.reference.norm(), 0.0);
    EXPECT_LT(check.largest_relative_difference, 1e-8) << measure;
  }
}

// The best Kp makes the gradient what the tolerances leave: finer steps change it by its own size.
TEST(Ensemble, AGradientThatIsRoundingIsNotCoarse) {
  for (const char* tolerances :
       {"relative_tolerance: 1.0e-5, absolute_tolerance: 1.0e-6", "relative_tolerance: 1.0e-8"}) {
    const Problem found = block(std::string("solver: {") + tolerances + "}\n",
                                "{algorithm: slsqp, relative_tolerance: 1.0e-14}");
    const OptimizationResult best = optimize(found);
    const Ensemble ensemble(found);
    for (const bool along : {false, true}) {
      GradientCheck check =
          along ? check_along(ensemble, best.best.rho, CheckMethod::kComplexStep)
                : check_gradient(ensemble, best.best.rho, CheckMethod::kComplexStep);
      check_other_steps(ensemble, best.best.rho, nullptr, &check);
      check_steps(ensemble, best.best.rho, nullptr, &check);
      ASSERT_TRUE(check.status.ok()) << check.status.cause;
      for (const Warning& warning : check.evaluation.warnings)
        EXPECT_NE(warning.code, "coarse_gradient") << tolerances << " " << warning.message;
    }
  }
}

// Runs of an ensemble go back over their own events, at other instants in each sample.
TEST(Ensemble, GradientsByTheAdjointOfMotionsThatSwitchAndEnd) {
  for (const char* measure : {"mean", "worst", "mean_plus_deviation, factor: 2.0"}) {
    const Problem problem =
        block(std::string(kUncertain) + "robust: {samples: 4, measure: " + measure +
                  "}\nloads: [{joint: slide, effort: \"${t < ts ? 5 : -5}\"}]\n"
                  "until: \"${slide/position > 0.45 or t > 0.7}\"\nsolver: {gradient: adjoint}\n",
              "{algorithm: slsqp}", ", ts: {initial: 0.3, lower: 0.1, upper: 0.7}");
    Ensemble ensemble(problem);
    const GradientCheck check =
        check_gradient(ensemble, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_GT(check.reference.cwiseAbs().minCoeff(), 0.0) << measure;
    EXPECT_LT(check.largest_relative_difference, 1e-8) << measure;
  }
}

// A replay of the same steps does not see that they are too long where friction reverses.
TEST(Ensemble, StepsThatAreTooLongForAGradientShow) {
  const std::string loop = source_dir() + "/test/features/planar_loop";
  const auto check_at = [&loop](const std::string& solver, CheckMethod method, int directions,
                                bool with_differences = false) {
    SourceText study = read_source(loop + ".yaml");
    study.text += "solver: {" + solver + "}\n";
    const Problem problem = load_problem(read_source(loop + ".urdf"), {}, study);
    const Ensemble ensemble(problem);
    GradientCheck check = directions > 0 ? check_along(ensemble, problem.start(), method)
                                         : check_gradient(ensemble, problem.start(), method);
    if (with_differences) check_other_steps(ensemble, problem.start(), nullptr, &check);
    check_steps(ensemble, problem.start(), nullptr, &check);
    EXPECT_TRUE(check.status.ok()) << check.status.cause;
    return check;
  };
  const auto warns = [](const GradientCheck& check) {
    const Warnings& warnings = check.evaluation.warnings;
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const Warning& warning) { return warning.code == "coarse_gradient"; });
  };
  const std::string loose = "relative_tolerance: 1.0e-4, absolute_tolerance: 1.0e-3",
                    tight = "relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10";
  for (const int directions : {0, 1}) {
    const GradientCheck coarse = check_at(loose, CheckMethod::kComplexStep, directions),
                        fine = check_at(tight, CheckMethod::kComplexStep, directions);
    EXPECT_LT(coarse.largest_relative_difference, 1e-8);
    EXPECT_GT(coarse.largest_change, 0.01);
    EXPECT_TRUE(warns(coarse));
    EXPECT_TRUE(warns(check_at(loose, CheckMethod::kComplexStep, directions, true)));
    EXPECT_LT(fine.largest_change, 1e-4);
    EXPECT_FALSE(warns(fine));
    EXPECT_EQ(fine.finer.size(), fine.reference.size());
  }
  // What changes is the error: differences of other runs agree with the finer steps.
  const GradientCheck coarse = check_at(loose, CheckMethod::kComplexStep, 0),
                      runs = check_at(loose, CheckMethod::kRidders, 0);
  EXPECT_LT((coarse.finer - runs.reference).norm(),
            0.2 * (coarse.evaluation.gradient - runs.reference).norm());
  EXPECT_EQ(runs.finer.size(), 0) << "known already";
  EXPECT_EQ(check_at(loose + ", sensitivity_tolerance: 1.0e-6", CheckMethod::kComplexStep, 0)
                .finer.size(),
            0)
      << "such steps are tested";
}

// The complex step of the scenarios does not check the measure itself: differences of the measure
// do.
TEST(Ensemble, GradientsOfMeasuresAgreeWithDifferences) {
  for (const char* measure : {"worst", "cvar, level: 0.6", "mean_plus_deviation, factor: 2.0"}) {
    const Problem problem =
        block(std::string(kUncertain) + "robust: {samples: 6, measure: " + measure + "}\n" +
              "solver: {relative_tolerance: 1.0e-10, absolute_tolerance: 1.0e-11}\n");
    Ensemble ensemble(problem);
    const Eigen::VectorXd gradient = ensemble.evaluate(problem.start(), true).total.gradient;
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double h = 1e-3;
      Eigen::VectorXd step = Eigen::VectorXd::Unit(2, k) * h;
      const double ahead = ensemble.evaluate(problem.start() + step, false).total.objective;
      const double behind = ensemble.evaluate(problem.start() - step, false).total.objective;
      EXPECT_NEAR((ahead - behind) / (2.0 * h), gradient[k], 1e-5 * gradient.norm()) << measure;
    }
  }
}

// Finite objectives of which squares overflow.
TEST(Ensemble, AMeasureThatIsNotFiniteIsAFailure) {
  Problem problem =
      block(std::string(kUncertain) + "robust: {samples: 2, measure: mean_plus_deviation}\n");
  Study study = study_of(problem);
  for (ObjectiveTerm& term : study.terminal) term.weight = Quantity(1e200);
  problem = with_study(problem, study);
  for (const bool with_gradient : {false, true}) {
    const EnsembleEvaluation all = Ensemble(problem).evaluate(problem.start(), with_gradient);
    EXPECT_EQ(all.total.status.code, StatusCode::kNonFinite);
    EXPECT_NE(all.total.status.cause.find("mean_plus_deviation"), std::string::npos)
        << all.total.status.cause;
    EXPECT_EQ(all.values.size(), 0);
  }
}

TEST(Ensemble, AFailedSampleRefusesTheDesignOrCountsInTheTail) {
  // A mass of the second run that no body can have.
  const std::string runs =
      "runs: {a: {}, b: {weight: 0.05, set: {mu: 0.4}}, c: {set: {mu: 0.2}}}\n";
  const Problem problem = block(runs + "robust: {measure: cvar, level: 0.9}\n");
  std::vector<Scenario> scenarios = make_scenarios(problem);
  scenarios[1].values = {{1, -1.0}};
  RobustOptions options = *study_of(problem).ensemble.robust;
  const auto engine = std::shared_ptr<EvaluationEngine>(make_engine({}, 3));
  const EnsembleEvaluation refused =
      Ensemble(scenarios, options, engine).evaluate(problem.start(), true);
  EXPECT_EQ(refused.total.status.code, StatusCode::kInvalidDesign);
  EXPECT_NE(refused.total.status.cause.find("run \"b\""), std::string::npos)
      << refused.total.status.cause;
  options.failed = FailedSamples::kTail;
  const EnsembleEvaluation counted =
      Ensemble(scenarios, options, engine).evaluate(problem.start(), true);
  ASSERT_TRUE(counted.total.status.ok()) << counted.total.status.cause;
  EXPECT_EQ(counted.failed, std::vector<int>{1});
  ASSERT_FALSE(counted.total.warnings.empty());
  const Warning& warning = counted.total.warnings.back();
  EXPECT_EQ(warning.code, "scenarios_failed");
  EXPECT_NE(warning.message.find("1 of 3 scenarios"), std::string::npos) << warning.message;
  EXPECT_NE(warning.message.find("run \"b\""), std::string::npos) << warning.message;
  EXPECT_EQ(counted.values[1], std::max(counted.values[0], counted.values[2]));
  scenarios[0].values = {{1, -1.0}};
  EXPECT_FALSE(
      Ensemble(scenarios, options, engine).evaluate(problem.start(), true).total.status.ok())
      << "half of all is no tail";
}

// The residuals of the mean are the residuals of all scenarios, times the roots of the weights.
TEST(Ensemble, TheRootOfTheMeanHasTheSumOfTheSquares) {
  const std::string runs = "runs: {a: {weight: 3.0}, b: {set: {mu: 0.4}}, c: {set: {mu: 0.2}}}\n";
  const Problem problem = block(runs + "robust: {measure: mean, failed: tail}\n");
  const Ensemble ensemble(problem);
  const EnsembleEvaluation all = ensemble.evaluate(problem.start(), Derivatives::kGaussNewton);
  ASSERT_TRUE(all.total.status.ok()) << all.total.status.cause;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2, 2);
  std::vector<Eigen::MatrixXd> squares;
  Evaluator evaluator(problem);
  for (const Scenario& scenario : ensemble.scenarios()) {
    const Evaluation one =
        evaluator.evaluate_design(scenario.parameters(problem.start()), Derivatives::kGaussNewton);
    squares.emplace_back(one.jacobian_root.transpose() * one.jacobian_root);
    sum += scenario.weight * squares.back();
  }
  EXPECT_LE((all.total.jacobian_root.transpose() * all.total.jacobian_root - sum).norm(),
            1e-12 * sum.norm());
  EXPECT_EQ(ensemble.evaluate(problem.start(), true).total.jacobian_root.size(), 0);
  // A scenario that fails counts as the worst of the others.
  std::vector<Scenario> scenarios = make_scenarios(problem);
  scenarios[2].values = {{1, -1.0}};
  RobustOptions options = *study_of(problem).ensemble.robust;
  options.level = 0.7;
  const auto engine = std::shared_ptr<EvaluationEngine>(make_engine({}, 3));
  const EnsembleEvaluation tail =
      Ensemble(scenarios, options, engine).evaluate(problem.start(), Derivatives::kGaussNewton);
  ASSERT_TRUE(tail.total.status.ok()) << tail.total.status.cause;
  ASSERT_EQ(tail.failed, std::vector<int>{2});
  const Eigen::MatrixXd& worst = squares[all.values[0] > all.values[1] ? 0 : 1];
  const Eigen::MatrixXd expected = 0.6 * squares[0] + 0.2 * squares[1] + 0.2 * worst;
  EXPECT_LE((tail.total.jacobian_root.transpose() * tail.total.jacobian_root - expected).norm(),
            1e-12 * expected.norm());
}

TEST(Ensemble, CancelledIsCancelled) {
  const Problem problem = block(kUncertain);
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(Ensemble(problem).evaluate(problem.start(), true, &cancel).total.status.code,
            StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
