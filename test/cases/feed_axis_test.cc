// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The numbers are in doc/case_studies.md.
#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"

namespace codesign {
namespace {

/// The case as one would write it for a drive without samples and delay.
Problem continuous_axis() {
  return shipped_problem("feed_axis", {{"    sample_time: 0.004\n", ""},
                                       {"    sample_time: 0.001\n", ""},
                                       {"    delay: 0.0005\n", ""}});
}

/// The objective of the sampled axis at the gains of a result.
double sampled_objective(const OptimizationResult& result) {
  const Problem problem = shipped_problem("feed_axis", {});
  const Evaluation evaluation = Evaluator(problem).evaluate(result.best.rho, true);
  EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  return evaluation.objective;
}

TEST(FeedAxis, TheTunedCascadeKeepsToTheRateOfItsDrive) {
  const OptimizationResult result = optimize(shipped_problem("feed_axis", {}));
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.initial.objective, 90.42, 0.01);
  EXPECT_LT(result.best.objective, 3.5);
  ASSERT_EQ(result.constraints.watched.size(), 1u);
  EXPECT_LE(result.constraints.watched[0].violation, 2e-8 * 2e4);
  EXPECT_NEAR(result.constraints.watched[0].largest, 2e4, 10.0) << "the bound is active";
  EXPECT_EQ(sampled_objective(result), result.best.objective);
}

TEST(FeedAxis, GainsTunedWithoutSamplesDoNotHoldOnTheSampledDrive) {
  const OptimizationResult result = optimize(continuous_axis());
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_LT(result.best.objective, 2.0);
  EXPECT_GT(sampled_objective(result), 50.0 * result.best.objective);
}

TEST(FeedAxis, BothIntegratorsAgree) {
  const auto run = [](const std::string& solver) {
    const Problem problem =
        shipped_problem("feed_axis", {{"integrator: rosenbrock, method: rodas5p", solver}});
    const Evaluation evaluation = Evaluator(problem).evaluate(problem.start(), true);
    EXPECT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
    return evaluation;
  };
  const Evaluation a = run("integrator: rosenbrock, method: rodas5p"), b = run("integrator: idas");
  EXPECT_NEAR(a.objective, b.objective, 1e-6 * a.objective);
  EXPECT_LT((a.gradient - b.gradient).cwiseAbs().maxCoeff(),
            1e-5 * a.gradient.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace codesign
