// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/projection.h"

#include <gtest/gtest.h>

#include "equations/compiled_system.h"
#include "integration/rosenbrock_integrator.h"
#include "integration/servo.h"

namespace codesign {
namespace {

TEST(Projection, TakesDriftAwayAndMovesByNoMore) {
  const auto system = compile(double_pendulum(), motion_study(1.0, "{shoulder: {position: 0.7, velocity: 2.0}}", "elbow/velocity", "{}"));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({}).ok());
  Projection projection(*system);
  State<double> state = integrator.state();
  const State<double> exact = state;
  for (Eigen::Index k = 0; k < state.q.size(); ++k) {
    state.q[k] += 1e-3 * std::sin(3.0 * static_cast<double>(k));
    state.v[k] += 1e-3 * std::cos(5.0 * static_cast<double>(k));
  }
  const State<double> drifted = state;
  ASSERT_TRUE(projection.apply(&integrator.equations(), &state));
  VectorX<double> Phi, Phi_rate;
  integrator.equations().constraint_errors(state, &Phi, &Phi_rate);
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(Phi_rate.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((state.q - exact.q).norm(), 2.0 * (drifted.q - exact.q).norm());
}

TEST(Projection, LeavesAConsistentStateAlone) {
  const auto system = compile(double_pendulum(), motion_study(1.0, "{shoulder: {position: 0.7, velocity: 2.0}}", "elbow/velocity", "{}"));
  RosenbrockIntegrator integrator(*system);
  ASSERT_TRUE(integrator.start({}).ok());
  State<double> state = integrator.state();
  ASSERT_TRUE(Projection(*system).apply(&integrator.equations(), &state));
  EXPECT_LT((state.q - integrator.state().q).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((state.v - integrator.state().v).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace codesign
