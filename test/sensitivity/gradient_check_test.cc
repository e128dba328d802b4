// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "assembly/make_system.h"
#include "integration/mechanisms.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// A bar that a spring-like controller turns; the objective is its angle at the end, a function of
/// the gain.
std::shared_ptr<const CompiledSystem> make(const std::string& initial_state) {
  const RobotDescription robot = read_urdf({"test.urdf", pendulum()});
  const std::string study =
      "duration: 1.0\ngravity: [0.0, 0.0, 0.0]\ninitial_state: {hinge: " + initial_state +
      "}\ncontrollers: {hold: {type: pid, input: hinge/position, setpoint: 0.0, output: hinge, "
      "gains: {p: \"${Kp}\"}}}\n"
      "parameters: {Kp: {initial: 3.0}}\nobjective: {terminal: [{signal: hinge/position}]}\n"
      "solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n";
  return make_system(robot, read_study({"test.yaml", study}, robot));
}

const Eigen::VectorXd kGain = Eigen::VectorXd::Constant(1, 3.0);

TEST(GradientCheck, BothReferencesMeetTheExactDerivative) {
  // psi = (a cos wt)^2 with w = sqrt(Kp / I) and t = 1: its derivative by Kp is -2 a^2 cos(w)
  // sin(w) w / (2 Kp).
  const double a = 0.5, w = std::sqrt(3.0 / (0.0834 + 0.25)),
               exact = -a * a * std::cos(w) * std::sin(w) * w / 3.0;
  for (CheckMethod method : {CheckMethod::kComplexStep, CheckMethod::kRidders}) {
    const GradientCheck check = check_gradient(make("{position: 0.5}"), kGain, method);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_NEAR(check.evaluation.gradient[0], exact, 1e-6 * std::abs(exact));
    EXPECT_NEAR(check.reference[0], exact, 1e-6 * std::abs(exact));
    EXPECT_LT(check.largest_relative_difference,
              method == CheckMethod::kComplexStep ? 1e-12 : 1e-6);
    EXPECT_EQ(check.reference_error[0] > 0.0, method == CheckMethod::kRidders);
  }
}

TEST(GradientCheck, AGradientOfZeroIsNoDivisionByIt) {
  const GradientCheck check =
      check_gradient(make("{position: 0.0}"), kGain, CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok());
  EXPECT_EQ(check.evaluation.gradient[0], 0.0);
  EXPECT_EQ(check.largest_relative_difference, 0.0);
}

TEST(GradientCheck, AWrongComponentShowsAlongEachDirection) {
  const Eigen::VectorXd right = (Eigen::VectorXd(5) << 3.0, -1e4, 0.02, 0.0, 7.0).finished();
  GradientCheck check;
  check.directions = check_directions(right, 2);
  check.reference = check.directions.transpose() * right;
  check.evaluation.gradient = right;
  compare(&check);
  EXPECT_LT(check.largest_relative_difference, 1e-12);
  for (Eigen::Index k = 0; k < right.size(); ++k) {
    check.evaluation.gradient = right;
    check.evaluation.gradient[k] += 1e-3 * std::max(std::abs(right[k]), 1e-3 * 1e4);
    check.largest_relative_difference = 0.0;
    compare(&check);
    EXPECT_GT(check.largest_relative_difference, 3e-4) << k;
    EXPECT_LT(check.largest_relative_difference, 3.1e-3) << k;
  }
}

TEST(GradientCheck, BothReferencesAlongADirectionMeetItsDerivative) {
  const Eigen::MatrixXd half = Eigen::MatrixXd::Constant(1, 1, 0.5);
  const auto system = make("{position: 0.5}");
  const Eigen::VectorXd gradient = evaluator_of(system).evaluate(kGain, true).gradient;
  for (CheckMethod method : {CheckMethod::kComplexStep, CheckMethod::kRidders}) {
    const GradientCheck check = check_design(system, {3.0}, method, nullptr, half);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_NEAR(check.reference[0], 0.5 * gradient[0], 1e-6 * std::abs(gradient[0]));
  }
}

TEST(GradientCheck, ACancelledOneSaysSo) {
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(
      check_gradient(make("{position: 0.5}"), kGain, CheckMethod::kRidders, &cancel).status.code,
      StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
