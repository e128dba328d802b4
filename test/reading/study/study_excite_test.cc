// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

// Lines 1 and 2; the motion is described in line 3.
const std::string kStudyToExcite =
    "parameters: {rod_length: {}, crank_length: {tune: false}}\nidentify: {}\n";
const std::string kOneJoint = "joints: {crank_joint: {velocity: 5.0}}, noise: 0.1";

ExcitationDescription excitation_of(const std::string& keys) {
  return read_text(kStudyToExcite + "excite: {" + keys + "}\n").excitation.value();
}

TEST(StudyExcite, Defaults) {
  EXPECT_FALSE(read_text(kLeastStudy).excitation.has_value());
  const ExcitationDescription description = excitation_of(kOneJoint);
  ASSERT_EQ(description.joints.size(), 1U);
  EXPECT_EQ(description.joints[0].limits.joint, "crank_joint");
  EXPECT_EQ(description.joints[0].limits.velocity, 5.0);
  EXPECT_FALSE(description.joints[0].limits.position.has_value());
  EXPECT_EQ(description.joints[0].noise, 0.1);
  EXPECT_EQ(description.trajectory, TrajectoryKind::kFourier);
  EXPECT_EQ(description.period, 10.0);
  EXPECT_EQ(description.harmonics, 5);
  EXPECT_EQ(description.periods, 1);
  EXPECT_EQ(description.sample_rate, 100.0);
  EXPECT_EQ(description.starts, 4);
  EXPECT_EQ(description.search, TrajectorySearchMethod::kSlsqp);
  EXPECT_EQ(description.max_evaluations, 1000);
}

TEST(StudyExcite, ReadsAllKeys) {
  const ExcitationDescription description = excitation_of(
      "joints: {crank_joint: {position: [-1, 2], velocity: 5, acceleration: 30, effort: 2, noise: "
      "0.2}}, "
      "limits: {slider_joint: {position: [0, 0.3], velocity: 1}}, trajectory: spline, knots: 30, "
      "period: 4, periods: 3, sample_rate: 200, "
      "starts: 7, seed: 9, search: ccsaq, max_evaluations: 50");
  const MotionLimitDescription& limits = description.joints.at(0).limits;
  EXPECT_EQ((*limits.position)[0], -1.0);
  EXPECT_EQ((*limits.position)[1], 2.0);
  EXPECT_EQ(limits.acceleration, 30.0);
  EXPECT_EQ(limits.effort, 2.0);
  EXPECT_EQ(limits.where.line, 3);
  EXPECT_EQ(limits.element, "excite.joints.crank_joint");
  EXPECT_EQ(description.joints[0].noise, 0.2);
  ASSERT_EQ(description.followers.size(), 1U);
  EXPECT_EQ(description.followers[0].velocity, 1.0);
  EXPECT_EQ(description.trajectory, TrajectoryKind::kSpline);
  EXPECT_EQ(description.knots, 30);
  EXPECT_EQ(description.period, 4.0);
  EXPECT_EQ(description.periods, 3);
  EXPECT_EQ(description.sample_rate, 200.0);
  EXPECT_EQ(description.starts, 7);
  EXPECT_EQ(description.seed, 9U);
  EXPECT_EQ(description.search, TrajectorySearchMethod::kCcsaq);
  EXPECT_EQ(description.max_evaluations, 50);
}

TEST(StudyExcite, DataAreNotThereYet) {
  EXPECT_TRUE(
      read_text(kStudyToExcite + "excite: {" + kOneJoint + "}\n").identification->data.empty());
}

}  // namespace
}  // namespace codesign
