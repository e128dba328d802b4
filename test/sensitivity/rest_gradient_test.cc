// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of mechanisms that rest, against closed forms: the motion has no error at any step
// size, but its sensitivities move; doc/theory.md (15d), (18f).
#include "sensitivity/gradient_check.h"
#include "sensitivity/gradient_engine.h"
#include "sensitivity/motions_at_rest.h"

namespace codesign {
namespace {

using Way = std::tuple<const char*, const char*, const char*>;

class RestGradientTest : public ::testing::TestWithParam<Way> {};

TEST_P(RestGradientTest, IsThatOfTheClosedForm) {
  const auto& [method, gradient, coordinates] = GetParam();
  const std::string solver = std::string("method: ") + method + ", gradient: " + gradient +
                             ", coordinates: " + coordinates;
  for (const MotionAtRest& rest : motions_at_rest()) {
    const auto system = rest.compile(solver);
    const GradientRun run =
        run_gradient(make_gradient_engine(*system).get(), *system, system->parameters());
    ASSERT_TRUE(run.status.ok()) << rest.name << ": " << run.status.cause;
    // Errors of the phase add up over 48 periods.
    const double bound = rest.name == "stiff_slide" ? 2e-3 : 2e-4;
    EXPECT_NEAR(run.gradient[0], rest.derivative, bound * rest.amplitude)
        << rest.name << " in " << run.steps << " steps";
  }
}

// The motion's errors are zero at every order of idas: sensitivities alone choose it.
TEST(RestGradient, ByIdasIsThatOfTheClosedForm) {
  for (const MotionAtRest& rest : motions_at_rest()) {
    const auto system = rest.compile("integrator: idas");
    const GradientRun run =
        run_gradient(make_gradient_engine(*system).get(), *system, system->parameters());
    ASSERT_TRUE(run.status.ok()) << rest.name << ": " << run.status.cause;
    EXPECT_NEAR(run.gradient[0], rest.derivative, 2e-3 * rest.amplitude)
        << rest.name << " in " << run.steps << " steps";
    EXPECT_LT(run.steps, 10000) << rest.name;
  }
}

// Differences of the objective see no step of the gradient.
TEST(RestGradient, IsThatOfDifferences) {
  for (const MotionAtRest& rest : motions_at_rest()) {
    const auto system = rest.compile("");
    const Eigen::VectorXd rho = Eigen::VectorXd::Constant(1, system->parameters()[0]);
    const GradientCheck check = check_gradient(system, rho, CheckMethod::kRidders);
    ASSERT_TRUE(check.status.ok()) << rest.name << ": " << check.status.cause;
    EXPECT_NEAR(check.evaluation.gradient[0], check.reference[0], 2e-4 * rest.amplitude)
        << rest.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, RestGradientTest,
                         ::testing::Combine(::testing::Values("auto", "dopri5", "rodas4",
                                                              "rodas4p2", "rodas5p"),
                                            ::testing::Values("direct", "adjoint"),
                                            ::testing::Values("joint", "absolute")));

}  // namespace
}  // namespace codesign
