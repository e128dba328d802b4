// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/confirmation.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "ensemble/other_steps.h"
#include "ensemble/other_steps_fixture.h"
#include "optimization/search_results.h"

namespace codesign {
namespace {

/// A search that ended at ts, where it took the gradient for `gradient`.
OptimizationResult ended_at(const Problem& problem, double ts, double gradient,
                            const std::string& termination = "objective_tolerance_reached",
                            const std::atomic<bool>* cancel = nullptr) {
  const Ensemble ensemble(problem);
  OptimizationResult result;
  result.termination = termination;
  result.best.rho = Eigen::VectorXd::Constant(1, ts);
  result.best.gradient = Eigen::VectorXd::Constant(1, gradient);
  const EnsembleEvaluation all = ensemble.evaluate(result.best.rho, false);
  result.best.objective = all.total.objective;
  result.best.values = all.values;
  result.best.slope = result.initial.slope = std::abs(gradient);
  result.optimality.stationarity = 0.0;
  result.cost.evaluations = 1;
  result.cost.statistics = all.total.statistics;
  confirm_stop(study_of(problem), problem.optimizer_options(), ensemble, cancel, &result);
  return result;
}

// A gradient that does not see the switching time takes every point for an optimum.
TEST(Confirmation, TakesTheSuccessFromASearchWhoseGradientIsRefuted) {
  const Problem problem = tuned_switch();
  const OptimizationResult result = ended_at(problem, 0.8, 0.0);
  EXPECT_TRUE(result.status.ok()) << "the best point is kept";
  EXPECT_EQ(result.termination, "stopped_early");
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].code, "gradient_disagrees");
  EXPECT_NE(stop_sentence(result).find("refute"), std::string::npos) << stop_sentence(result);
  EXPECT_LE(result.optimality.independent.evaluations, kMostEvaluations);
}

// psi vanishes where x(2) = 4 ts - ts^2 - 2 = 2, at ts = 2, outside of the bounds; at ts = 1.9 the
// derivative is 2 (-0.01) (0.2), which the bound holds.
TEST(Confirmation, LeavesAnOptimumAlone) {
  const Problem problem = tuned_switch();
  const OptimizationResult result = ended_at(problem, 1.9, -0.004);
  EXPECT_EQ(result.termination, "objective_tolerance_reached");
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_TRUE(result.optimality.independent.is_known());
  EXPECT_EQ(stop_sentence(result), "stationary to 0");
  EXPECT_GT(result.cost.statistics.steps, result.optimality.independent.statistics.steps)
      << "the search pays for it";
}

TEST(Confirmation, DoesNotLookWhereNothingIsClaimed) {
  for (const char* termination : {"max_evaluations_reached", "cancelled", "start_failed"})
    EXPECT_EQ(ended_at(tuned_switch(), 0.8, 0.0, termination).optimality.independent.evaluations, 0)
        << termination;
}

TEST(Confirmation, ThatIsCancelledCancelsTheSearch) {
  const std::atomic<bool> cancel{true};
  const OptimizationResult result =
      ended_at(tuned_switch(), 0.8, 0.0, "objective_tolerance_reached", &cancel);
  EXPECT_EQ(result.status.code, StatusCode::kCancelled);
  EXPECT_EQ(result.termination, "cancelled");
}

// Beside this design none can be computed, which the sentence says.
TEST(Confirmation, SaysWhatItDoesNotKnow) {
  OptimizationResult result;
  result.termination = "objective_tolerance_reached";
  result.optimality.stationarity = 1e-6;
  IndependentCheck& check = result.optimality.independent;
  EXPECT_EQ(stop_sentence(result), "stationary to 1e-06");
  check.status = {StatusCode::kTooManySteps, 0.5, "more than 4000 steps (solver.maximum_steps)"};
  EXPECT_NE(stop_sentence(result).find("not known"), std::string::npos);
  EXPECT_NE(stop_sentence(result).find("4000 steps"), std::string::npos);
  check.status = {};
  check.direction = Eigen::VectorXd::Ones(1);
  check.size = 2.0;
  check.error = 0.5;
  check.allowed = 0.1;
  EXPECT_NE(stop_sentence(result).find("an error of 0.25"), std::string::npos)
      << stop_sentence(result);
}

}  // namespace
}  // namespace codesign
