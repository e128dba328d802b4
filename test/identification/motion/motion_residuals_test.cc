// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/motion_residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/motion_rig.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// Residuals of a recording, with the objects that they need.
struct MotionCase {
  MotionCase(const Problem& of, const std::vector<JointRecording>& recordings, int threads = 1)
      : problem(of),
        variables(study_of(problem)),
        residuals(*system_of(problem), variables, *study_of(problem).identification,
                  require_same_joints(recordings), recordings, threads, &warnings) {}

  Problem problem;
  FitVariables variables;
  Warnings warnings;
  MotionResiduals residuals;
};

TEST(MotionResiduals, AreSmallAtTheTruthUnderRecordedEfforts) {
  MotionRig rig;
  rig.begin = 1.5e6;
  MotionCase c(motion_problem("", "  segment: 1.0\n  filter: {cutoff: 20.0, decimate: 2}\n",
                              "inertia: {}, viscous: {}, dry: {}"),
               {record_pendulum(rig)});
  EXPECT_EQ(c.residuals.outputs(), std::vector<std::string>{"hinge/position"});
  EXPECT_EQ(c.residuals.rows(), 301);
  EXPECT_EQ(c.residuals.lengths(), SeriesLengths{301});
  EXPECT_EQ(c.residuals.own_unknowns(), 6 * 2);
  EXPECT_NEAR(c.residuals.times().back(), 1.5e6 + 6.0, 1e-9);
  const Eigen::VectorXd truth = Eigen::Vector3d(0.2, 0.3, 0.5);
  ASSERT_TRUE(c.residuals.begin(truth).ok());
  Eigen::MatrixXd residuals;
  const Status status = c.residuals.evaluate(truth, &residuals, nullptr);
  ASSERT_TRUE(status.ok()) << status.cause;
  // The effort is known at the samples alone, and interpolated between them.
  EXPECT_LT(residuals.cwiseAbs().maxCoeff(), 2e-5);
  ASSERT_TRUE(c.residuals.evaluate(c.variables.start(), &residuals, nullptr).ok());
  EXPECT_GT(residuals.cwiseAbs().maxCoeff(), 0.05);
}

TEST(MotionResiduals, TheControllersOfTheStudyDriveWhereTheyAreInTheLoop) {
  MotionRig rig;
  rig.with_effort = false;
  MotionCase c(
      motion_problem(motion_servo(), "  segment: 1.0\n", "inertia: {}, viscous: {}, dry: {}"),
      {record_pendulum(rig)});
  EXPECT_EQ(c.residuals.outputs(), std::vector<std::string>{"hinge/position"});
  EXPECT_EQ(c.residuals.own_unknowns(), 6 * 3) << "the integral of the servo is free, too";
  const Eigen::VectorXd truth = Eigen::Vector3d(0.2, 0.3, 0.5);
  ASSERT_TRUE(c.residuals.begin(truth).ok());
  Eigen::MatrixXd residuals;
  const Status status = c.residuals.evaluate(truth, &residuals, nullptr);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_LT(residuals.cwiseAbs().maxCoeff(), 2e-5);
}

TEST(MotionResiduals, TheJacobianIsThatOfTheBestStarts) {
  // Close to the truth, where residuals are small and the neglected second derivatives do not
  // count.
  MotionRig rig;
  rig.with_velocity = true;
  MotionCase c(
      motion_problem(
          motion_servo() + "solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n",
          "  segment: 1.5\n", "inertia: {}, viscous: {}, dry: {}"),
      {record_pendulum(rig)});
  EXPECT_EQ(c.residuals.outputs(),
            (std::vector<std::string>{"hinge/position", "hinge/velocity", "hinge/effort"}));
  const Eigen::VectorXd truth = Eigen::Vector3d(0.2, 0.3, 0.5);
  ASSERT_TRUE(c.residuals.begin(truth).ok());
  Eigen::MatrixXd residuals, jacobian, before, after;
  ASSERT_TRUE(c.residuals.evaluate(truth, &residuals, nullptr).ok());
  ASSERT_TRUE(c.residuals.evaluate(truth, &after, &jacobian).ok());
  EXPECT_EQ(after, residuals) << "a run with further derivatives, from the best starts";
  ASSERT_EQ(jacobian.rows(), residuals.size());
  for (Eigen::Index k = 0; k < 3; ++k) {
    constexpr double kStep = 1e-3;
    Eigen::VectorXd x = truth;
    x[k] += kStep;
    ASSERT_TRUE(c.residuals.evaluate(x, &after, nullptr).ok());
    x[k] -= 2.0 * kStep;
    ASSERT_TRUE(c.residuals.evaluate(x, &before, nullptr).ok());
    const Eigen::VectorXd difference = (after - before).reshaped() / (2.0 * kStep);
    EXPECT_LT((jacobian.col(k) - difference).norm(), 5e-3 * difference.norm()) << k;
    EXPECT_GT(difference.norm(), 0.0);
  }
}

TEST(MotionResiduals, APointWithDerivativesTakesOneRunAndSaysWhatItsStartsOwe) {
  MotionRig rig;
  rig.noise = 1e-3;
  MotionCase c(motion_problem("", "  segment: 1.0\n  filter: {cutoff: 20.0}\n",
                              "inertia: {}, viscous: {}, dry: {}"),
               {record_pendulum(rig)});
  const Eigen::VectorXd truth = Eigen::Vector3d(0.2, 0.3, 0.5);
  ASSERT_TRUE(c.residuals.begin(truth).ok());
  Eigen::MatrixXd best, residuals, jacobian;
  ASSERT_TRUE(c.residuals.evaluate(truth, &best, nullptr).ok());
  EXPECT_EQ(c.residuals.whole_runs(), 0.0) << "no derivatives were asked for";
  // The same from the measured starts, step by step.
  MotionCase steps(c.problem, {record_pendulum(rig)});
  steps.residuals.count_by(Eigen::VectorXd::Constant(1, 1e-3),
                           study_of(c.problem).identification->loss);
  ASSERT_TRUE(steps.residuals.begin(truth).ok());
  double inner_decrease = 0.0, cost = 0.0;
  for (int step = 1; step <= 3; ++step) {
    ASSERT_TRUE(steps.residuals.evaluate(truth, &residuals, &jacobian).ok());
    EXPECT_EQ(steps.residuals.whole_runs(), step);
    const double now = residuals.squaredNorm() / 1e-6;
    if (step > 1) {
      EXPECT_NEAR(cost - now, inner_decrease, 0.02 * inner_decrease)
          << "the predicted_decrease of step " << step << " is kept";
    }
    inner_decrease = steps.residuals.inner_decrease();
    cost = now;
    if (step == 1) {
      EXPECT_GT(inner_decrease, 1e-3 * cost);
    }
  }
  EXPECT_EQ(steps.residuals.runs(), steps.residuals.whole_runs());
  EXPECT_LT(inner_decrease, 1e-6 * cost);
  EXPECT_NEAR(residuals.squaredNorm(), best.squaredNorm(), 1e-7 * best.squaredNorm());
}

TEST(MotionResiduals, APointWhoseStartsWentTooFarGetsItsBestStarts) {
  // The second point is far from the first one, where the starts were bad, too: they do not keep
  // their predicted_decrease.
  MotionRig rig;
  rig.noise = 1e-3;
  MotionCase c(motion_problem("", "  segment: 3.0\n  filter: {cutoff: 20.0}\n",
                              "inertia: {}, viscous: {}, dry: {}"),
               {record_pendulum(rig)}),
      other(c.problem, {record_pendulum(rig)});
  const Eigen::VectorXd near = Eigen::Vector3d(0.2, 0.3, 0.5), far = Eigen::Vector3d(0.6, 0.9, 0.1);
  for (MotionCase* each : {&c, &other}) ASSERT_TRUE(each->residuals.begin(near).ok());
  Eigen::MatrixXd best, residuals, jacobian;
  for (int step = 1; step <= 4; ++step)
    ASSERT_TRUE(c.residuals.evaluate(near, &residuals, &jacobian).ok());
  ASSERT_TRUE(c.residuals.evaluate(far, &residuals, &jacobian).ok());
  ASSERT_TRUE(other.residuals.evaluate(far, &best, nullptr).ok());
  EXPECT_GT(best.norm(), 0.1);
  EXPECT_LT(residuals.norm(), 1.1 * best.norm());
  EXPECT_GT(c.residuals.runs(), c.residuals.whole_runs());
}

TEST(MotionResiduals, ManyThreadsGiveTheSameBits) {
  MotionRig rig;
  rig.noise = 1e-3;
  const Problem problem =
      motion_problem("", "  segment: 0.7\n", "inertia: {}, viscous: {}, dry: {}");
  const JointRecording recording = record_pendulum(rig);
  MotionCase one(problem, {recording, recording}, 1), many(problem, {recording, recording}, 3);
  Eigen::MatrixXd residuals[2], jacobians[2];
  Eigen::VectorXd x = one.variables.start();
  ASSERT_TRUE(one.residuals.begin(x).ok());
  ASSERT_TRUE(many.residuals.begin(x).ok());
  for (int repeat = 0; repeat < 2; ++repeat, x *= 1.1) {
    ASSERT_TRUE(one.residuals.evaluate(x, &residuals[0], &jacobians[0]).ok());
    ASSERT_TRUE(many.residuals.evaluate(x, &residuals[1], &jacobians[1]).ok());
    EXPECT_EQ(residuals[0], residuals[1]);
    EXPECT_EQ(jacobians[0], jacobians[1]);
  }
}

TEST(MotionResiduals, ASegmentThatCannotBeSimulatedIsNamed) {
  const Problem problem = motion_problem("solver: {maximum_steps: 3}\n", "  segment: 1.0\n",
                                         "inertia: {}, viscous: {}");
  MotionRig rig;
  rig.begin = 7.0;
  MotionCase c(problem, {record_pendulum(rig)});
  ASSERT_TRUE(c.residuals.begin(c.variables.start()).ok());
  Eigen::MatrixXd residuals;
  const Status status = c.residuals.evaluate(c.variables.start(), &residuals, nullptr);
  EXPECT_EQ(status.code, StatusCode::kTooManySteps);
  EXPECT_NE(status.cause.find("segment at 7 s of identify.data[0]"), std::string::npos)
      << status.cause;
}

TEST(MotionResiduals, CancelEndsAnEvaluation) {
  MotionCase c(motion_problem("", "", "inertia: {}"), {record_pendulum(MotionRig())});
  const std::atomic<bool> cancel{true};
  ASSERT_TRUE(c.residuals.begin(c.variables.start()).ok());
  c.residuals.obey(&cancel);
  Eigen::MatrixXd residuals;
  EXPECT_EQ(c.residuals.evaluate(c.variables.start(), &residuals, nullptr).code,
            StatusCode::kCancelled);
}

TEST(MotionResiduals, RefusesShortSegmentsAndIdas) {
  const JointRecording recording = record_pendulum(MotionRig());
  try {
    MotionCase(motion_problem("", "  segment: 0.02\n", "inertia: {}"), {recording});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.segment") << error.what();
  }
  try {
    MotionCase(motion_problem("solver: {integrator: idas}\n", "", "inertia: {}"), {recording});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "solver.integrator") << error.what();
  }
}

TEST(MotionResiduals, FrictionStatesThatNobodyRecordedAreTold) {
  const JointRecording recording = record_pendulum(MotionRig());
  std::string robot = motion_pendulum();
  const std::string damper = "<dynamics damping=\"0.1\"";
  ASSERT_NE(robot.find(damper), std::string::npos);
  robot.insert(robot.find(damper),
               "<codesign:friction model=\"lugre\" mu_static=\"0.3\" mu_dynamic=\"0.2\" "
               "transition_velocity=\"0.02\" joint_length=\"0.1\" "
               "pin_radius=\"0.05\"/>");
  const std::string study =
      "identify: {data: [{csv: data.csv}], residual: motion}\nparameters: {inertia: {}}\n";
  const Problem bristles = load_problem({"pendulum.urdf", robot}, {}, {"study.yaml", study});
  const auto told = [](const MotionCase& c) {
    return std::count_if(c.warnings.begin(), c.warnings.end(),
                         [](const Warning& w) { return w.code == "segment_friction_states"; });
  };
  EXPECT_EQ(told(MotionCase(bristles, {recording})), 1);
  EXPECT_EQ(told(MotionCase(motion_problem("", "  segment: 1.0\n", "inertia: {}"), {recording})),
            0);
}

TEST(MotionResiduals, RefusesSampledControllers) {
  std::string servo = motion_servo();
  const std::string pid = "type: pid, ";
  ASSERT_NE(servo.find(pid), std::string::npos) << servo;
  servo.replace(servo.find(pid), pid.size(), pid + "sample_time: 0.01, ");
  EXPECT_THROW(MotionCase(motion_problem(servo, "  segment: 1.0\n", "inertia: {}"),
                          {record_pendulum(MotionRig())}),
               InputError);
}

TEST(MotionResiduals, RefusesRecordingsWithoutPositions) {
  JointRecording recording = record_pendulum(MotionRig());
  recording.joints.front().position.clear();
  EXPECT_THROW(MotionCase(motion_problem("", "  segment: 1.0\n", "inertia: {}"), {recording}),
               InputError);
}

}  // namespace
}  // namespace codesign
