// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of mechanisms that rest, against closed forms: the motion has no error at any step
// size, but its sensitivities move; doc/theory.md (15d), (18f).
#include "sensitivity/gradient_engine.h"
#include "sensitivity/motions_at_rest.h"

namespace codesign {
namespace {

using Parameter = std::tuple<const char*, const char*, const char*>;

class RestGradient : public ::testing::TestWithParam<Parameter> {};

TEST_P(RestGradient, IsThatOfTheClosedForm) {
  const auto& [method, gradient, coordinates] = GetParam();
  const bool idas = std::string(method) == "idas";
  if (idas && std::string(gradient) == "adjoint") return;  // which only rosenbrock has
  const std::string solver = std::string(idas ? "integrator: " : "method: ") + method +
                             ", gradient: " + gradient + ", coordinates: " + coordinates;
  for (const MotionAtRest& rest : motions_at_rest()) {
    const auto system = rest.compile(solver);
    const GradientRun run =
        run_gradient(make_gradient_engine(*system).get(), *system, system->parameters());
    ASSERT_TRUE(run.status.ok()) << rest.name << ": " << run.status.cause;
    if (getenv("REST_PRINT"))
      printf("%-16s %-9s %-8s %-9s %8ld steps, relative error %.2e\n", rest.name.c_str(), method,
             gradient, coordinates, static_cast<long>(run.steps),
             (run.gradient[0] - rest.derivative) / rest.derivative);
    EXPECT_NEAR(run.gradient[0], rest.derivative, 1e-4 * std::abs(rest.derivative)) << rest.name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Ways, RestGradient,
    ::testing::Combine(::testing::Values("auto", "dopri5", "rodas4", "rodas4p2", "rodas5p", "idas"),
                       ::testing::Values("direct", "adjoint"),
                       ::testing::Values("joint", "absolute")));

}  // namespace
}  // namespace codesign
