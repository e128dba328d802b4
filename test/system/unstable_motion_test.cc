// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Haug's slider-crank where it is hard: gains of the wrong sign, a stuck slider, a stiff controller. Counts of steps, no times.
#include "mechanism_codesign/optimization/optimizer.h"
#include "system/shipped.h"

namespace codesign {
namespace {

constexpr Eigen::Index kGain = 4;

class HardSliderCrank : public ::testing::Test {
 protected:
  Evaluation evaluate(double Kp, bool with_gradient = false) const {
    Eigen::VectorXd rho = shipped.start();
    rho[kGain] = Kp;
    return Evaluator(make_system(shipped.robot, shipped.study)).evaluate(rho, with_gradient);
  }
  void start_at(double Kp) { shipped.study.parameters[static_cast<std::size_t>(shipped.study.tuned[kGain])].value = Kp; }

  Shipped shipped{"slider_crank_haug"};
};

// Without the watch: 55 000 steps for a gain of -0.1, 400 000 and more for the others.
TEST_F(HardSliderCrank, RunsAwayOnlyBriefly) {
  for (const double Kp : {-0.1, -1.0, -5.0}) {
    const Evaluation evaluation = evaluate(Kp);
    EXPECT_EQ(evaluation.status.code, StatusCode::kUnstableMotion) << Kp << ": " << evaluation.status.cause;
    EXPECT_NE(evaluation.status.cause.find("link 'crank' turns"), std::string::npos) << evaluation.status.cause;
    EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 8000) << Kp;
  }
}

TEST_F(HardSliderCrank, RunsAwayOnlyBrieflyWithIdas) {
  shipped.study.solver.integrator = "idas";
  for (const double Kp : {-0.1, -5.0}) {
    const Evaluation evaluation = evaluate(Kp);
    EXPECT_EQ(evaluation.status.code, StatusCode::kUnstableMotion) << Kp << ": " << evaluation.status.cause;
    EXPECT_LT(evaluation.statistics.steps + evaluation.statistics.rejected_steps, 12000) << Kp;
  }
}

// From Kp = 0.05 down the slope of a made-up objective: the less speed the better, so that the search goes for the wrong sign.
TEST_F(HardSliderCrank, AnOptimizerThatStepsThereGoesOn) {
  shipped.study.solver.relative_tolerance = 1e-6;
  shipped.study.solver.absolute_tolerance = 1e-7;
  shipped.study.optimizer.algorithm = "cobyla";
  shipped.study.optimizer.max_evaluations = 25;
  start_at(0.1);
  const auto system = make_system(shipped.robot, shipped.study);
  int failed = 0;
  const OptimizationResult result = optimize(system, shipped.study, [&](const Trial& trial) {
    if (!trial.status.ok()) ++failed;
    return true;
  });
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_GT(failed, 0);
  EXPECT_EQ(result.failed_evaluations, failed);
  EXPECT_LT(result.objective, result.initial_objective);
}

TEST_F(HardSliderCrank, AnOptimizerThatStartsThereSaysWhy) {
  start_at(-1.0);
  const OptimizationResult result = optimize(make_system(shipped.robot, shipped.study), shipped.study);
  EXPECT_EQ(result.status.code, StatusCode::kUnstableMotion);
  EXPECT_EQ(result.evaluations, 1);
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
