// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/lagrangian.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"

namespace codesign {
namespace {

TEST(Lagrangian, HasNoGradientAtABoundedOptimum) {
  const Problem problem =
      block("path: [{signal: hold/output, between: [-6, 6]}]\n", "{algorithm: slsqp, relative_tolerance: 1.0e-11, max_evaluations: 400}");
  const Ensemble ensemble(problem);
  const Scaling scaling(problem.study());
  SmoothProgram program(ensemble);
  const auto residual = [&](const Eigen::VectorXd& rho) {
    return lagrangian_residual(ensemble.evaluate(rho, true), rho, scaling, 1.0, &program);
  };
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double free = scaling.gradient_norm(result.gradient);
  EXPECT_GT(free, 0.0);
  EXPECT_LT(residual(result.rho), 1e-3 * free) << "the bound holds the gradient";
  EXPECT_NEAR(residual(problem.start()), scaling.gradient_norm(result.initial_gradient), 1e-9) << "nothing is active at the start";
}

}  // namespace
}  // namespace codesign
