// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Haug's slider-crank in difficult cases: gains of the wrong sign, a stuck slider, a stiff
// controller. Steps are counted, not times.
#include <algorithm>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "mechanism_codesign/optimization.h"
#include "optimization/search_hooks.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

constexpr Eigen::Index kGain = 4;

class HardSliderCrank : public ::testing::Test {
 protected:
  Evaluation evaluate(double Kp, bool with_gradient = false) const {
    Eigen::VectorXd rho = shipped.start();
    rho[kGain] = Kp;
    return evaluator_of(make_system(shipped.robot, shipped.study)).evaluate(rho, with_gradient);
  }
  /// Sets the gain at which the optimizer starts.
  void start_at(double Kp) {
    shipped.study.parameters[static_cast<std::size_t>(shipped.study.tuned[kGain])].value = Kp;
  }

  static Shipped by_rodas4() {
    Shipped shipped("slider_crank_haug");
    shipped.study.solver.method = RosenbrockMethod::kRodas4;
    shipped.study.solver.relative_tolerance = 1e-8;
    shipped.study.solver.absolute_tolerance = 1e-9;
    shipped.study.solver.sensitivity_tolerance = 0.0;
    return shipped;
  }

  Shipped shipped = by_rodas4();
};

// Without MotionWatch these runs take 55 000 steps for a gain of -0.1, 400 000 and more for the
// others.
TEST_F(HardSliderCrank, RunsAwayOnlyBriefly) {
  for (const double Kp : {-0.1, -1.0, -5.0}) {
    const Evaluation evaluation = evaluate(Kp);
    EXPECT_EQ(evaluation.status.code, StatusCode::kUnstableMotion)
        << Kp << ": " << evaluation.status.cause;
    EXPECT_NE(evaluation.status.cause.find("link 'crank' turns"), std::string::npos)
        << evaluation.status.cause;
    EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 8000) << Kp;
  }
}

TEST_F(HardSliderCrank, RunsAwayOnlyBrieflyWithIdas) {
  shipped.study.solver.integrator = IntegratorKind::kIdas;
  for (const double Kp : {-0.1, -5.0}) {
    const Evaluation evaluation = evaluate(Kp);
    EXPECT_EQ(evaluation.status.code, StatusCode::kUnstableMotion)
        << Kp << ": " << evaluation.status.cause;
    EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 12000) << Kp;
  }
}

// With the term for the error removed, less effort is always better, so the search passes Kp = 0 to
// gains of the wrong sign.
TEST_F(HardSliderCrank, AnOptimizerThatStepsThereGoesOn) {
  shipped.study.tuned = {shipped.study.tuned[kGain]};
  shipped.study.constraints.clear();
  shipped.study.integral.erase(shipped.study.integral.begin());
  shipped.study.solver.relative_tolerance = 1e-6;
  shipped.study.solver.absolute_tolerance = 1e-7;
  shipped.study.optimizer.algorithm = "lbfgs";
  shipped.study.optimizer.max_evaluations = 15;
  std::vector<StatusCode> codes;
  const OptimizationResult result = optimize(make_system(shipped.robot, shipped.study),
                                             shipped.study.optimizer, [&](const Trial& trial) {
                                               codes.push_back(trial.status.code);
                                               return true;
                                             });
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  const auto failed = std::count(codes.begin(), codes.end(), StatusCode::kUnstableMotion);
  EXPECT_GT(failed, 0);
  EXPECT_EQ(codes.back(), StatusCode::kSuccess) << "it went on";
  EXPECT_EQ(result.cost.failed_evaluations, failed);
  EXPECT_LT(result.best.objective, result.initial.objective);
}

TEST_F(HardSliderCrank, AnOptimizerThatStartsThereSaysWhy) {
  start_at(-1.0);
  const OptimizationResult result =
      optimize(make_system(shipped.robot, shipped.study), shipped.study.optimizer);
  EXPECT_EQ(result.status.code, StatusCode::kUnstableMotion);
  EXPECT_EQ(result.cost.evaluations, 1);
}

TEST_F(HardSliderCrank, AStuckSliderNeedsNoTinySteps) {
  for (JointDescription& joint : shipped.robot.joints)
    if (joint.friction) joint.friction->transition_velocity = Quantity(1e-3);
  const Evaluation evaluation = evaluate(0.03);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 1000);
}

TEST_F(HardSliderCrank, AStiffControllerNeedsNoTinySteps) {
  const Evaluation evaluation = evaluate(5.0);
  ASSERT_TRUE(evaluation.status.ok()) << evaluation.status.cause;
  EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 6000);
}

}  // namespace
}  // namespace codesign
