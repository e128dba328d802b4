// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/segment_fit.h"

#include <gtest/gtest.h>

#include "identification/motion_rig.h"
#include "identification/segments.h"

namespace codesign {
namespace {

/// The second segment of the pendulum's recording.
struct FittedSegment {
  explicit FittedSegment(const MotionRig& rig, const std::string& more = "")
      : problem(motion_problem(motion_servo() + "solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n",
                               "  segment: 1.0\n" + more, "inertia: {}, viscous: {}, dry: {}")),
        recording(record_pendulum(rig)),
        variables(problem.study()),
        joints{{"hinge", true, 1.0, {}}},
        of(make_segment_system(*problem.system(), variables, joints, {"hinge"}, motion_outputs(*problem.system(), joints, {recording}),
                               recording)),
        segments(cut_into_segments(recording, of, variables, {"hinge"}, *problem.study().identification, &warnings)) {
    EXPECT_TRUE(set_branches(recording, of, *problem.system(), variables, truth, {"hinge"}, nullptr, &segments).ok());
    for (const MotionOutput& output : of.outputs) {
      efforts.emplace_back();
      if (output.quantity == MeasuredQuantity::kEffort) efforts.back().emplace(recording.times, recording.joints.front().effort);
    }
    spreads = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(of.outputs.size()), 0.01);
  }

  SegmentSolution fit(const std::vector<Eigen::VectorXd>& guesses, SegmentWork work = SegmentWork::kBestStart) {
    SegmentRun run(of, segments.front().begin);
    return fit_segment({of, variables, efforts, segments.at(1), truth, spreads, problem.study().identification->loss}, guesses, work, &run);
  }

  Problem problem;
  JointRecording recording;
  FitVariables variables;
  std::vector<MeasuredJoint> joints;
  SegmentSystem of;
  Warnings warnings;
  const Eigen::VectorXd truth = Eigen::Vector3d(0.2, 0.3, 0.5);
  std::vector<Segment> segments;
  std::vector<std::optional<RecordedEffort>> efforts;
  Eigen::VectorXd spreads;
};

TEST(SegmentFit, FindsPositionVelocityAndIntegral) {
  MotionRig rig;
  rig.with_velocity = true;
  FittedSegment segment(rig);
  const SegmentSolution solution = segment.fit({segment.segments.at(1).start});
  ASSERT_TRUE(solution.status.ok()) << solution.status.cause;
  EXPECT_NEAR(solution.start[0], segment.recording.joints[0].position[100], 1e-6);
  EXPECT_NEAR(solution.start[1], segment.recording.joints[0].velocity[100], 1e-5);
  EXPECT_GT(std::abs(solution.start[2]), 1e-3) << "the integral of the first second";
  EXPECT_LT(solution.residuals.cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LE(solution.runs, 6);
  EXPECT_EQ(solution.whole_runs, 0);
  EXPECT_LE(solution.promise, 1e-4 * solution.value);
}

TEST(SegmentFit, WhatAStartExplainsIsNotInTheJacobian) {
  MotionRig rig;
  rig.noise = 0.01;
  FittedSegment segment(rig);
  const SegmentSolution best = segment.fit({segment.segments.at(1).start});
  ASSERT_TRUE(best.status.ok());
  const SegmentSolution solution = segment.fit({best.start}, SegmentWork::kElimination);
  ASSERT_TRUE(solution.status.ok());
  EXPECT_EQ(solution.residuals, best.residuals);
  EXPECT_EQ(solution.runs, 1);
  EXPECT_EQ(solution.whole_runs, 1);
  SegmentRun run(segment.of, segment.segments.front().begin);
  const Segment& at = segment.segments.at(1);
  ASSERT_TRUE(run.run(segment.of.parameters(segment.variables, segment.truth, solution.start), at.begin, at.times).ok());
  // Residuals of efforts are computed minus recorded: their derivatives equal the derivatives of the run.
  const Eigen::MatrixXd by_start = run.slopes().rightCols(segment.of.starts);
  const Eigen::VectorXd weights = Eigen::VectorXd::Constant(by_start.rows(), 1.0 / 0.01);
  const Eigen::MatrixXd weighted = weights.asDiagonal() * by_start;
  EXPECT_LT((weighted.transpose() * (weights.asDiagonal() * solution.jacobian)).cwiseAbs().maxCoeff(),
            1e-8 * weighted.norm() * (weights.asDiagonal() * solution.jacobian).norm());
  // The start is the best one.
  EXPECT_LT((weighted.transpose() * (solution.residuals.reshaped() / 0.01)).norm(), 1e-3 * weighted.norm() * std::sqrt(solution.value));
}

TEST(SegmentFit, AnEliminationTellsWhatTheBestStartWouldGain) {
  MotionRig rig;
  rig.noise = 0.01;
  FittedSegment segment(rig);
  const SegmentSolution best = segment.fit({segment.segments.at(1).start});
  ASSERT_TRUE(best.status.ok());
  Eigen::VectorXd near = best.start;
  near[0] += 0.003;
  const SegmentSolution solution = segment.fit({near}, SegmentWork::kElimination);
  ASSERT_TRUE(solution.status.ok());
  EXPECT_GT(solution.promise, 0.0);
  EXPECT_NEAR(solution.value - best.value, solution.promise, 0.02 * solution.promise);
  EXPECT_LT((solution.start - solution.correction - best.start).norm(), 0.02 * solution.correction.norm());
}

TEST(SegmentFit, AGuessThatCannotBeSimulatedGivesWayToTheNext) {
  FittedSegment segment{MotionRig()};
  Eigen::VectorXd absurd = segment.segments.at(1).start;
  absurd[1] = 1e12;
  const SegmentSolution solution = segment.fit({absurd, segment.segments.at(1).start});
  EXPECT_TRUE(solution.status.ok()) << solution.status.cause;
  EXPECT_FALSE(segment.fit({absurd}).status.ok());
}

}  // namespace
}  // namespace codesign
