// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "sensitivity/adjoint_jump.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"
#include "sensitivity/hybrid_cases.h"
#include "sensitivity/lane_directions.h"
#include "sensitivity/tangent_step.h"

namespace codesign {
namespace {

/// A run with the tangents of all its parameters.
class TangentRun {
 public:
  TangentRun(const CompiledSystem& system, int parameters)
      : integrator(system), tangent(system, rosenbrock_tableau(system.study().solver.method)) {
    EXPECT_TRUE(integrator.start(system.parameters()).ok());
    const LaneRange<8> all{0, parameters};
    tangent.start(all.seed(system, system.parameters()), integrator.assembly(),
                  integrator.initial_state(), integrator.mode());
  }
  void advance() {
    const auto attempt = [this](OneStep<double>* step) {
      tangent.attempt(step);
      return 0.0;
    };
    const double before = integrator.state().t;
    ASSERT_TRUE(integrator.advance(integrator.end(), attempt).ok());
    if (integrator.state().t > before) tangent.accept(integrator.step());
  }

  RosenbrockIntegrator integrator;
  TangentStep<8> tangent;
};

VectorX<double> irregular(Eigen::Index size, double first) {
  VectorX<double> x(size);
  for (double& entry : x) entry = std::sin(first += 1.7);
  return x;
}

class AdjointJumpTest : public ::testing::TestWithParam<const char*> {};

// psi_y+ y+_rho = psi_y- y-_rho + psi_rho for any psi_y+, at each jump of a run.
TEST_P(AdjointJumpTest, IsTheTransposedTangent) {
  int jumps_seen = 0, guards_seen = 0;
  for (const HybridCase& test : hybrid_cases()) {
    const auto system = test.compile(GetParam());
    const auto p = static_cast<int>(system->study().tuned.size());
    TangentRun run(*system, p);
    AdjointJump reversed(*system);
    while (!run.integrator.has_ended()) {
      const State<double> before = run.integrator.state();
      const std::vector<bool> mode = run.integrator.mode();
      ASSERT_TRUE(run.integrator.jump().ok());
      if (run.integrator.has_jumped()) {
        RunJumps jump;
        jump.append(0, run.integrator);
        const Directions<8> y = run.tangent.directions();
        run.tangent.jump(&run.integrator);
        const VectorX<double> after =
            irregular(run.tangent.directions().cols(), static_cast<double>(jumps_seen));
        VectorX<double> adjoint = after;
        Eigen::VectorXd gradient = Eigen::VectorXd::Zero(p);
        reversed.start(system->parameters());
        ASSERT_TRUE(
            reversed.reverse(*jump.at(0), before, run.integrator.state(), mode, 0.0, &adjoint));
        reversed.add_gradient(gradient);
        const Eigen::VectorXd expected = (run.tangent.directions() * after).head(p),
                              found = (y * adjoint).head(p) + gradient,
                              sizes = (y.cwiseAbs() * adjoint.cwiseAbs()).head(p);
        for (int k = 0; k < p; ++k)
          EXPECT_NEAR(found[k], expected[k], 1e-10 * (1.0 + sizes[k] + std::abs(expected[k])))
              << test.name << " at " << before.t << ", parameter " << k;
        ++jumps_seen;
        guards_seen += jump.at(0)->guard >= 0 ? 1 : 0;
      }
      run.advance();
    }
  }
  EXPECT_GT(jumps_seen, 100);
  EXPECT_GT(guards_seen, 10);
}

INSTANTIATE_TEST_SUITE_P(Coordinates, AdjointJumpTest,
                         ::testing::Values("method: rodas5p", "method: dopri5",
                                           "method: rodas4, coordinates: absolute"));

// A slide of 1 kg at v: s = x - edge is zero, where the force changes from 0 to -0.5 N.
TEST(AdjointJump, AddsAGuardWithItsWeight) {
  const HybridCase test{"slide", robot(mass("piston", 1.0) + lift("slide", "piston", 0.0)),
                        R"(duration: 1.0
gravity: [0, 0, 0]
initial_state: {slide: {velocity: 2.0}}
parameters: {edge: {initial: 0.7}}
loads: [{joint: slide, effort: "${slide/position > 3*edge ? -0.5 : 0}"}]
objective: {terminal: [{signal: slide/position}]}
)"};
  const auto system = test.compile("method: rodas4");
  RosenbrockIntegrator run(*system);
  ASSERT_TRUE(run.start(system->parameters()).ok());
  ASSERT_TRUE(run.jump().ok());
  AdjointJump jump(*system);
  VectorX<double> adjoint = VectorX<double>::Zero(IncrementLayout(system->layout()).size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(1);
  jump.start(system->parameters());
  jump.add_guard(0, 5.0, run.state(), run.mode(), &adjoint);
  jump.add_gradient(gradient);
  // y - x of the comparison 3 edge < position.
  EXPECT_NEAR(adjoint[0], 5.0, 1e-12);
  EXPECT_NEAR(adjoint.norm(), 5.0, 1e-12);
  EXPECT_NEAR(gradient[0], -15.0, 1e-12);
}

}  // namespace
}  // namespace codesign
