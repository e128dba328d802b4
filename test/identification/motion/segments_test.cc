// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "assembly/assembly.h"
#include "description/study.h"
#include "identification/motion/segments.h"
#include "identification/motion_rig.h"
#include "paths.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// The second segment of the pendulum's recording.
struct FittedSegment {
  explicit FittedSegment(const MotionRig& rig, const std::string& more = "")
      : problem(motion_problem(
            motion_servo() + "solver: {relative_tolerance: 1.0e-9, absolute_tolerance: 1.0e-10}\n",
            "  segment: 1.0\n" + more, "inertia: {}, viscous: {}, dry: {}")),
        recording(record_pendulum(rig)),
        variables(study_of(problem)),
        joints{{"hinge", true, 1.0, {}}},
        of(make_segment_system(*system_of(problem), variables, joints, {"hinge"},
                               motion_outputs(*system_of(problem), joints, {recording}),
                               recording)),
        segments(cut_into_segments(recording, of, variables, {"hinge"},
                                   *study_of(problem).identification, &warnings)) {
    EXPECT_TRUE(set_branches(recording, of, *system_of(problem), variables, truth, {"hinge"},
                             nullptr, &segments)
                    .ok());
    for (const MotionOutput& output : of.outputs) {
      efforts.emplace_back();
      if (output.quantity == MeasuredQuantity::kEffort)
        efforts.back().emplace(recording.times, recording.joints.front().effort);
    }
    spreads = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(of.outputs.size()), 0.01);
  }

  SegmentSolution fit(const std::vector<Eigen::VectorXd>& guesses,
                      SegmentWork work = SegmentWork::kBestStart) {
    SegmentRun run(of, segments.front().begin);
    return fit_segment({of, variables, efforts, segments.at(1), truth, spreads,
                        study_of(problem).identification->loss},
                       guesses, work, &run);
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
  EXPECT_LE(solution.predicted_decrease, 1e-4 * solution.value);
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
  ASSERT_TRUE(run.run(segment.of.parameters(segment.variables, segment.truth, solution.start),
                      at.begin, at.times)
                  .ok());
  // Residuals of efforts are computed minus recorded: their derivatives equal the derivatives of
  // the run.
  const Eigen::MatrixXd by_start = run.slopes().rightCols(segment.of.starts);
  const Eigen::VectorXd weights = Eigen::VectorXd::Constant(by_start.rows(), 1.0 / 0.01);
  const Eigen::MatrixXd weighted = weights.asDiagonal() * by_start;
  EXPECT_LT(
      (weighted.transpose() * (weights.asDiagonal() * solution.jacobian)).cwiseAbs().maxCoeff(),
      1e-8 * weighted.norm() * (weights.asDiagonal() * solution.jacobian).norm());
  // The start is the best one.
  EXPECT_LT((weighted.transpose() * (solution.residuals.reshaped() / 0.01)).norm(),
            1e-3 * weighted.norm() * std::sqrt(solution.value));
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
  EXPECT_GT(solution.predicted_decrease, 0.0);
  EXPECT_NEAR(solution.value - best.value, solution.predicted_decrease,
              0.02 * solution.predicted_decrease);
  EXPECT_LT((solution.start - solution.correction - best.start).norm(),
            0.02 * solution.correction.norm());
}

TEST(SegmentFit, AGuessThatCannotBeSimulatedGivesWayToTheNext) {
  FittedSegment segment{MotionRig()};
  Eigen::VectorXd absurd = segment.segments.at(1).start;
  absurd[1] = 1e12;
  const SegmentSolution solution = segment.fit({absurd, segment.segments.at(1).start});
  EXPECT_TRUE(solution.status.ok()) << solution.status.cause;
  EXPECT_FALSE(segment.fit({absurd}).status.ok());
}

TEST(Segments, EachSampleIsInOneOfThem) {
  const Problem problem =
      motion_problem("", "  segment: 1.0\n  filter: {cutoff: 20.0, decimate: 3}\n", "inertia: {}");
  MotionRig rig;
  rig.duration = 5.4;
  rig.begin = 100.0;
  const JointRecording recording = record_pendulum(rig);
  const FitVariables variables(study_of(problem));
  const std::vector<MeasuredJoint> joints{{"hinge", true, 1.0, {}}};
  const SegmentSystem of =
      make_segment_system(*system_of(problem), variables, joints, {"hinge"},
                          motion_outputs(*system_of(problem), joints, {recording}), recording);
  EXPECT_EQ(of.epoch, 100.0);
  Warnings warnings;
  const std::vector<Segment> segments = cut_into_segments(
      recording, of, variables, {"hinge"}, *study_of(problem).identification, &warnings);
  ASSERT_EQ(segments.size(), 5U) << "the last one is longer";
  std::size_t sample = 0;
  for (const Segment& segment : segments) {
    EXPECT_EQ(segment.begin.time, segment.times.front());
    EXPECT_NEAR(segment.start[0], recording.joints[0].position[sample], 2e-3);
    for (std::size_t k = 0; k < segment.times.size(); ++k, sample += 3) {
      EXPECT_EQ(segment.times[k], recording.times[sample] - 100.0);
      EXPECT_EQ(segment.recorded(static_cast<Eigen::Index>(k), 0),
                recording.joints[0].position[sample]);
    }
  }
  EXPECT_GE(sample, recording.times.size());
  EXPECT_TRUE(warnings.empty());
}

TEST(Segments, ShorterThanTheStepsOfTheRecordingTheyAreRefused) {
  const Problem problem = motion_problem("", "  segment: 1.0e-9\n", "inertia: {}");
  const JointRecording recording = record_pendulum({});
  const FitVariables variables(study_of(problem));
  const std::vector<MeasuredJoint> joints{{"hinge", true, 1.0, {}}};
  const SegmentSystem of =
      make_segment_system(*system_of(problem), variables, joints, {"hinge"},
                          motion_outputs(*system_of(problem), joints, {recording}), recording);
  Warnings warnings;
  try {
    cut_into_segments(recording, of, variables, {"hinge"}, *study_of(problem).identification,
                      &warnings);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.segment");
    EXPECT_GT(error.fault().where.line, 0);
    EXPECT_EQ(error.fault().value, "1e-09");
    EXPECT_NE(error.fault().message.find("1 samples that count, too few"), std::string::npos)
        << error.what();
  }
}

TEST(Segments, ALoopStaysOnItsBranchThroughWholeTurns) {
  const Problem problem =
      load_problem(read_source(source_dir() + "/urdf/slider_crank.urdf"), {},
                   {"study.yaml",
                    "initial_state: {crank_joint: {position: 0.0}}\nidentify:\n  data: [{csv: "
                    "data.csv}]\n  residual: motion\n  segment: 0.5\n"
                    "parameters: {crank_length: {}}\n"});
  JointRecording recording;
  JointSamples crank{"crank_joint", {}, {}, {}};
  for (int k = 0; k <= 200; ++k) {
    recording.times.push_back(0.01 * k);
    crank.position.push_back(1.0 - 0.1 * k);
  }
  recording.joints = {crank};
  const FitVariables variables(study_of(problem));
  const std::vector<MeasuredJoint> joints{{"crank_joint", false, 1.0, {}}};
  const SegmentSystem of =
      make_segment_system(*system_of(problem), variables, joints, {"crank_joint"},
                          motion_outputs(*system_of(problem), joints, {recording}), recording);
  Warnings warnings;
  std::vector<Segment> segments = cut_into_segments(recording, of, variables, {"crank_joint"},
                                                    *study_of(problem).identification, &warnings);
  const Status status = set_branches(recording, of, *system_of(problem), variables,
                                     variables.start(), {"crank_joint"}, nullptr, &segments);
  ASSERT_TRUE(status.ok()) << status.cause;
  // All segments have the slider on the side where it is at the start of the study.
  const RobotDescription& robot = system_of(problem)->robot();
  StartWorkspace usual(*system_of(problem), system_of(problem)->parameters());
  ASSERT_TRUE(usual.solve_positions().ok());
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint) {
    if (robot.joints[joint].name != "slider_joint") continue;
    const int at = usual.assembly.tree().offset[joint];
    for (const Segment& segment : segments)
      EXPECT_GT(segment.begin.theta[at] * usual.assembly.theta()[at], 0.0)
          << "at " << segment.begin.time;
  }
}

}  // namespace

}  // namespace codesign
