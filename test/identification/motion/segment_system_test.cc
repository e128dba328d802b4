// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/motion/segment_system.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "identification/effort/effort_residuals.h"
#include "identification/motion_rig.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

JointRecording recorded(bool with_velocity, bool with_effort, double begin = 0.0) {
  MotionRig rig;
  rig.duration = 1.0;
  rig.with_velocity = with_velocity;
  rig.with_effort = with_effort;
  rig.begin = begin;
  return record_pendulum(rig);
}

std::vector<std::string> outputs_of(const Problem& problem,
                                    const std::vector<JointRecording>& recordings) {
  std::vector<std::string> names;
  for (const MotionOutput& output :
       motion_outputs(*system_of(problem), require_same_joints(recordings), recordings))
    names.push_back(output.name());
  return names;
}

TEST(SegmentSystem, OutputsAreWhatAllRecordingsHave) {
  using Names = std::vector<std::string>;
  const Problem left_alone = motion_problem("", "", "inertia: {}"),
                in_loop = motion_problem(motion_servo(), "", "inertia: {}");
  EXPECT_EQ(outputs_of(left_alone, {recorded(true, true)}),
            (Names{"hinge/position", "hinge/velocity"}));
  EXPECT_EQ(outputs_of(left_alone, {recorded(true, true), recorded(false, true)}),
            Names{"hinge/position"});
  EXPECT_EQ(outputs_of(in_loop, {recorded(false, true)}),
            (Names{"hinge/position", "hinge/effort"}));
  JointRecording still = recorded(true, true);
  for (double& velocity : still.joints[0].velocity) velocity = 0.0;
  EXPECT_EQ(outputs_of(left_alone, {still}), Names{"hinge/position"}) << "zeros were not measured";
}

TEST(SegmentSystem, SensorsOfInputsAndTheStartFollowTheParameters) {
  const Problem problem = motion_problem(
      "",
      "  joints: {hinge: {effort_scale: 3.0, delay: {initial: 0.01}, offset: {initial: 0.2}}}\n",
      "viscous: {}, dry: {}");
  const JointRecording recording = recorded(false, true, 40.0);
  const FitVariables variables(study_of(problem));
  const SegmentSystem of = make_segment_system(
      *system_of(problem), variables, require_same_joints({recording}), {"hinge"},
      motion_outputs(*system_of(problem), require_same_joints({recording}), {recording}),
      recording);
  EXPECT_EQ(of.inputs, std::vector<std::string>{"hinge"});
  EXPECT_EQ(of.columns, (std::vector<int>{0, 1, 2, 3})) << "the known scale is not tuned";
  EXPECT_EQ(of.starts, 2);
  EXPECT_EQ(of.epoch, 40.0);
  EXPECT_NEAR(of.system->study().duration, 1.0, 1e-12);
  Eigen::VectorXd x(4);
  x << 0.6, 0.7, 0.02, 0.3;
  // inertia, viscous, dry; scale, delay, offset; position, velocity
  const std::vector<double> expected{0.1, 0.6, 0.7, 3.0, 0.02, 0.3, 1.5, -2.0};
  EXPECT_EQ(of.parameters(variables, x, Eigen::Vector2d(1.5, -2.0)), expected);
  EXPECT_EQ(of.system->study().tuned, (std::vector<int>{1, 2, 4, 5, 6, 7}));
}

TEST(SegmentSystem, AControllerKeepsItsClockAndItsIntegralIsFree) {
  const Problem problem = motion_problem(motion_servo(), "", "viscous: {}");
  const JointRecording recording = recorded(false, true, 40.0);
  const FitVariables variables(study_of(problem));
  const SegmentSystem of = make_segment_system(
      *system_of(problem), variables, require_same_joints({recording}), {"hinge"},
      motion_outputs(*system_of(problem), require_same_joints({recording}), {recording}),
      recording);
  EXPECT_TRUE(of.inputs.empty()) << "the servo drives, and its effort is compared";
  EXPECT_EQ(of.epoch, 0.0);
  EXPECT_EQ(of.starts, 3);
  EXPECT_EQ(of.system->layout().states, 1);
}

}  // namespace
}  // namespace codesign
