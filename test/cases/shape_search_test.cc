// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// A force as a function of time with 200 coefficients, of the table of stops in
// benchmark/sweeps.md.
#include <algorithm>

#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

/// Of a search with a relative tolerance of 1e-10, stationary to 9e-6.
constexpr double kOptimum = 0.0351318094;

OptimizationResult search(const std::string& algorithm, double tolerance) {
  const std::string folder = source_dir() + "/benchmark/stops/";
  const Problem problem = load_problem(read_source(folder + "cart_pole.urdf"), {},
                                       read_source(folder + "cart_pole_shape.yaml"));
  OptimizerOptions options = problem.optimizer_options();
  options.algorithm = algorithm;
  options.relative_tolerance = tolerance;
  return optimize(problem, options);
}

bool warns(const OptimizationResult& result) {
  return std::any_of(result.warnings.begin(), result.warnings.end(), [](const Warning& one) {
    return one.code == "not_stationary" || one.code == "max_evaluations_reached";
  });
}

TEST(ShapeSearch, AutoEndsAtTheOptimum) {
  const OptimizationResult result = search("auto", 1e-6);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.best.rho.size(), 200);
  EXPECT_NEAR(result.best.objective, kOptimum, 1e-3 * kOptimum);
  EXPECT_LT(result.optimality.stationarity, 1e-3);
  EXPECT_FALSE(warns(result));
}

// Its steps are small after 45 evaluations, 1.1 % above the optimum: there it ended as a success.
TEST(ShapeSearch, LbfgsEndsAtTheOptimumOrWarns) {
  const OptimizationResult result = search("lbfgs", 1e-4);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_TRUE(result.best.objective < 1.001 * kOptimum || warns(result))
      << result.best.objective << " " << result.termination;
}

}  // namespace
}  // namespace codesign
