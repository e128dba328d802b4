// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of an objective of a loop's angle after many turns, with a spring that counts them.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/servo.h"
#include "integration/turning_loops.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

using Solver = std::tuple<const char*, const char*>;

class LoopTurnsGradient : public testing::TestWithParam<Solver> {};

// theta = (v/w) sin w t with w = sqrt(k/I), psi = (theta(5) - v/3)^2. In absolute coordinates steps
// resolve each turn, so that fewer turns do.
TEST_P(LoopTurnsGradient, IsThatOfTheFormula) {
  const auto& [coordinates, more] = GetParam();
  const bool is_joint = coordinates == std::string("joint");
  const double speed = is_joint ? 300.0 : 30.0, aim = speed / 3.0;
  const auto system = compile(
      rotor_with_slides(pin_spring()),
      std::string(
          "duration: 5.0\ngravity: [0, 0, 0]\ninitial_state: {crank: {position: 0, "
          "velocity: " +
          std::to_string(speed) +
          "}}\n"
          "parameters: {k: {tune: true, lower: 0.0005, upper: 0.003}}\nobjective: {terminal: "
          "[{signal: pin/position, reference: " +
          std::to_string(aim) +
          "}]}\nsolver: {relative_tolerance: 1e-8, "
          "absolute_tolerance: 1e-8, coordinates: ") +
          coordinates + ", " + more + "}\n");
  const double I = kRotorInertia, k = 0.001, t = 5.0, w = std::sqrt(k / I),
               theta = speed / w * std::sin(w * t),
               theta_w = -theta / w + speed * t / w * std::cos(w * t),
               exact = 2.0 * (theta - aim) * theta_w * 0.5 / std::sqrt(k * I);
  const GradientCheck check =
      check_gradient(system, Eigen::VectorXd::Constant(1, k), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  const double tolerance = is_joint ? 1e-4 : 2e-3;
  EXPECT_NEAR(check.evaluation.objective, std::pow(theta - aim, 2),
              tolerance * std::pow(theta - aim, 2));
  EXPECT_NEAR(check.evaluation.gradient[0], exact, tolerance * std::abs(exact));
  EXPECT_LT(check.largest_relative_difference,
            check.method == CheckMethod::kComplexStep ? 1e-9 : 1e-3);
}

// Without a load steps are hundreds of turns long: psi = (0.3 + 2 v - 30)^2.
TEST_P(LoopTurnsGradient, CountsTheTurnsOfLongSteps) {
  const auto& [coordinates, more] = GetParam();
  const auto system = compile(
      rotor_with_slides(),
      std::string("duration: 2.0\ngravity: [0, 0, 0]\ninitial_state: {crank: {position: 0.3, "
                  "velocity: \"${v}\"}}\nparameters: {v: {initial: 40, lower: 1, upper: 100}}\n"
                  "objective: {terminal: [{signal: pin/position, reference: 30}]}\nsolver: "
                  "{coordinates: ") +
          coordinates + ", " + more + "}\n");
  const GradientCheck check =
      check_gradient(system, Eigen::VectorXd::Constant(1, 40.0), CheckMethod::kComplexStep);
  ASSERT_TRUE(check.status.ok()) << check.status.cause;
  EXPECT_NEAR(check.evaluation.objective, 50.3 * 50.3, 1.0);
  EXPECT_NEAR(check.evaluation.gradient[0], 2.0 * 50.3 * 2.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Solvers, LoopTurnsGradient,
                         testing::Combine(testing::Values("joint", "absolute"),
                                          testing::Values("method: dopri5, gradient: direct",
                                                          "method: dopri5, gradient: adjoint",
                                                          "method: rodas5p, gradient: direct",
                                                          "method: rodas5p, gradient: adjoint",
                                                          "integrator: idas")));

}  // namespace
}  // namespace codesign
