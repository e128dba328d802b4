// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

// Few starts, to save time; doc/case_studies.md has the result of all.
TEST(GovernorMultistart, TwoStartsFindTheirWayIntoTheValley) {
  const Problem problem =
      shipped_problem("governor_multistart", {{"starts: 8, screen: 48", "starts: 2, screen: 4"},
                                              {"max_evaluations: 120", "max_evaluations: 25"}});
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  ASSERT_EQ(result.multistart.starts.size(), 2U);
  EXPECT_EQ(result.multistart.screened - result.multistart.unusable, 4);
  EXPECT_LE(result.multistart.starts[0].start_objective,
            result.multistart.starts[1].start_objective);
  for (const StartResult& start : result.multistart.starts) EXPECT_LT(start.objective, 0.64);
  EXPECT_LT(result.best.objective, 0.62);
  EXPECT_EQ(result.best.objective,
            std::min(result.multistart.starts[0].objective, result.multistart.starts[1].objective));
  EXPECT_NEAR(result.initial.objective, 18.9929, 1e-3) << "of the study's own start";
}

// The best design that the shipped study finds, at the tolerances of the case governor.
TEST(GovernorMultistart, TheBestDesignKeepsItsObjectiveAtTightTolerances) {
  const Shipped shipped("governor");
  Eigen::VectorXd rho(7);
  rho << 0.15, 0.06, 0.2913452155, 0.03, 0.02, 0.2021834058, 0.04;
  const Evaluation evaluation =
      evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(rho, false);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_NEAR(evaluation.objective, 0.58578, 1e-5);
}

}  // namespace
}  // namespace codesign
