// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/segments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assembly/start_workspace.h"
#include "identification/motion_rig.h"
#include "identification/segment_fit.h"
#include "paths.h"

namespace codesign {
namespace {

TEST(Segments, EachSampleIsInOneOfThem) {
  const Problem problem = motion_problem("", "  segment: 1.0\n  filter: {cutoff: 20.0, decimate: 3}\n", "inertia: {}");
  MotionRig rig;
  rig.duration = 5.4;
  rig.begin = 100.0;
  const JointRecording recording = record_pendulum(rig);
  const FitVariables variables(problem.study());
  const std::vector<MeasuredJoint> joints{{"hinge", true, 1.0, {}}};
  const SegmentSystem of = make_segment_system(*problem.system(), variables, joints, {"hinge"},
                                               motion_outputs(*problem.system(), joints, {recording}), recording);
  EXPECT_EQ(of.epoch, 100.0);
  Warnings warnings;
  const std::vector<Segment> segments = cut_into_segments(recording, of, variables, {"hinge"}, *problem.study().identification, &warnings);
  ASSERT_EQ(segments.size(), 5U) << "the last one is longer";
  std::size_t sample = 0;
  for (const Segment& segment : segments) {
    EXPECT_EQ(segment.begin.time, segment.times.front());
    EXPECT_NEAR(segment.start[0], recording.joints[0].position[sample], 2e-3);
    for (std::size_t k = 0; k < segment.times.size(); ++k, sample += 3) {
      EXPECT_EQ(segment.times[k], recording.times[sample] - 100.0);
      EXPECT_EQ(segment.recorded(static_cast<Eigen::Index>(k), 0), recording.joints[0].position[sample]);
    }
  }
  EXPECT_GE(sample, recording.times.size());
  EXPECT_TRUE(warnings.empty());
}

TEST(Segments, ShorterThanTheStepsOfTheRecordingTheyAreRefused) {
  const Problem problem = motion_problem("", "  segment: 1.0e-9\n", "inertia: {}");
  const JointRecording recording = record_pendulum({});
  const FitVariables variables(problem.study());
  const std::vector<MeasuredJoint> joints{{"hinge", true, 1.0, {}}};
  const SegmentSystem of = make_segment_system(*problem.system(), variables, joints, {"hinge"},
                                               motion_outputs(*problem.system(), joints, {recording}), recording);
  Warnings warnings;
  try {
    cut_into_segments(recording, of, variables, {"hinge"}, *problem.study().identification, &warnings);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.segment");
    EXPECT_GT(error.fault().where.line, 0);
    EXPECT_EQ(error.fault().value, "1e-09");
    EXPECT_NE(error.fault().message.find("1 samples that count, too few"), std::string::npos) << error.what();
  }
}

TEST(Segments, ALoopStaysOnItsBranchThroughWholeTurns) {
  const Problem problem = load_problem(
      read_source(source_dir() + "/urdf/slider_crank.urdf"), {},
      {"study.yaml",
       "initial_state: {crank_joint: {position: 0.0}}\nidentify:\n  data: [{csv: data.csv}]\n  residual: motion\n  segment: 0.5\n"
       "parameters: {crank_length: {}}\n"});
  JointRecording recording;
  JointSamples crank{"crank_joint", {}, {}, {}};
  for (int k = 0; k <= 200; ++k) {
    recording.times.push_back(0.01 * k);
    crank.position.push_back(1.0 - 0.1 * k);
  }
  recording.joints = {crank};
  const FitVariables variables(problem.study());
  const std::vector<MeasuredJoint> joints{{"crank_joint", false, 1.0, {}}};
  const SegmentSystem of = make_segment_system(*problem.system(), variables, joints, {"crank_joint"},
                                               motion_outputs(*problem.system(), joints, {recording}), recording);
  Warnings warnings;
  std::vector<Segment> segments = cut_into_segments(recording, of, variables, {"crank_joint"}, *problem.study().identification, &warnings);
  const Status status = set_branches(recording, of, *problem.system(), variables, variables.start(), {"crank_joint"}, nullptr, &segments);
  ASSERT_TRUE(status.ok()) << status.cause;
  // All segments have the slider on the side where it is at the start of the study.
  const RobotDescription& robot = problem.system()->robot();
  StartWorkspace usual(*problem.system(), problem.system()->parameters());
  ASSERT_TRUE(usual.solve_positions().ok());
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint) {
    if (robot.joints[joint].name != "slider_joint") continue;
    const int at = usual.assembly.tree().offset[joint];
    for (const Segment& segment : segments)
      EXPECT_GT(segment.begin.theta[at] * usual.assembly.theta()[at], 0.0) << "at " << segment.begin.time;
  }
}

}  // namespace
}  // namespace codesign
