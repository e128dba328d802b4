// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "identification/comparison/compared_motion.h"

#include <gtest/gtest.h>

#include "description/study.h"
#include "identification/identify.h"
#include "identification/swinging_arm.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kRate = 20.0;

struct Compared {
  explicit Compared(const SwingingRig& rig, const std::string& more = "",
                    std::function<bool()> stop = {})
      : problem(swinging_problem("{csv: data.csv}", more)) {
    recordings.data = {rig.record("identify.data[0]")};
    SwingingRig later = rig;
    later.start = 7.0;
    recordings.holdout = {later.record("identify.holdout[0]")};
    result = identify(problem, recordings, {}, nullptr);
    motion = compare_motion(problem, recordings, result, kRate, stop);
  }

  Problem problem;
  StudyRecordings recordings;
  IdentificationResult result;
  ComparedMotion motion;
};

TEST(CompareMotion, TheModelMovesAsMeasuredAndNeedsTheEffortsThatItNeeds) {
  const SwingingRig rig;
  const Compared compared(rig);
  ASSERT_TRUE(compared.result.status.ok()) << compared.result.status.cause;
  ASSERT_EQ(compared.motion.recordings.size(), 2U);
  const std::string elements[] = {"identify.data[0]", "identify.holdout[0]"};
  for (std::size_t r = 0; r < 2; ++r) {
    const ComparedRecording& recording = compared.motion.recordings[r];
    EXPECT_EQ(recording.element, elements[r]);
    ASSERT_TRUE(recording.status.ok()) << recording.status.cause;
    ASSERT_EQ(recording.model.size(), 100U);
    ASSERT_EQ(recording.measured.size(), 100U);
    for (std::size_t k = 0; k < recording.model.size(); ++k) {
      const Frame &model = recording.model[k], &measured = recording.measured[k];
      const double t = (r == 0 ? 0.0 : 7.0) + 0.02 +
                       0.05 * static_cast<double>(k);  // four samples at the ends are not fitted
      ASSERT_NEAR(model.time, t, 1e-12);
      EXPECT_EQ(measured.time, model.time);
      EXPECT_NEAR(model.joints[0].position, rig.position(t), 1e-9);
      EXPECT_NEAR(model.joints[0].velocity, rig.velocity(t), 1e-9);
      EXPECT_NEAR(measured.joints[0].position, rig.position(t), 1e-12);
      EXPECT_NEAR(measured.joints[0].effort, rig.torque(t), 1e-9);
      // Accelerations are differences of the velocities.
      EXPECT_NEAR(model.joints[0].effort, rig.torque(t), 1e-4) << t;
      const Eigen::Vector3d x = model.links[1].orientation * Eigen::Vector3d::UnitX();
      EXPECT_NEAR(x.x(), std::cos(rig.position(t)), 1e-9);
      EXPECT_NEAR(x.y(), std::sin(rig.position(t)), 1e-9);
    }
  }
}

TEST(CompareMotion, EffortsAreWhatTheIdentifiedSensorSaysOfThem) {
  SwingingRig rig;
  rig.scale = 11.0;
  rig.offset = 0.2;
  Problem problem = load_problem(
      {"arm.urdf", kSwingingArm}, {},
      {"study.yaml",
       "identify:\n  data: [{csv: data.csv}]\n  joints: {hinge: {effort_scale: 11.0, offset: {}}}\n"
       "parameters: {inertia: {}, viscous: {}}\n"});
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok());
  const ComparedMotion motion = compare_motion(problem, recordings, result, kRate);
  const Frame& measured = motion.recordings[0].measured[20];
  EXPECT_NEAR(measured.joints[0].effort, rig.torque(measured.time), 1e-4);
}

TEST(CompareMotion, PositionsBeginAtTheIdentifiedStart) {
  const SwingingRig rig;
  const Problem problem = swinging_problem("{csv: data.csv, start: {hinge: {initial: 0.7}}}");
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  recordings.data[0].joints[0].position.clear();
  recordings.data[0].joints[0].start =
      study_of(problem).identification->data[0].starts.at(0).position;
  IdentificationResult result;
  result.parameters = {0.3, 0.4};
  result.x = Eigen::Vector3d(0.3, 0.4, 0.0);  // the arm begins at 0, not at 0.7
  const ComparedMotion motion = compare_motion(problem, recordings, result, kRate);
  ASSERT_EQ(motion.recordings.size(), 1U);
  ASSERT_TRUE(motion.recordings[0].status.ok()) << motion.recordings[0].status.cause;
  for (std::size_t k = 0; k < motion.recordings[0].model.size(); ++k) {
    const Frame &model = motion.recordings[0].model[k],
                &measured = motion.recordings[0].measured[k];
    EXPECT_NEAR(measured.joints[0].position, rig.position(measured.time), 1e-6);
    EXPECT_NEAR(model.joints[0].position, rig.position(measured.time), 1e-6);
  }
}

TEST(CompareMotion, WhichJointsAreCompared) {
  const ComparedMotion motion = Compared(SwingingRig()).motion;
  ASSERT_EQ(motion.joints.size(), 1U);
  EXPECT_EQ(motion.names.joints[motion.joints[0].joint], "hinge");
  EXPECT_EQ(motion.names.links[motion.joints[0].link], "bar");
  EXPECT_EQ(motion.joints[0].axis, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(motion.joints[0].is_torque);
}

// The columns of a series with residuals in motion, here 0.1 rad and 0.2 rad/s from the measured
// values, at every fourth sample.
TEST(CompareMotion, AModelThatMovesByItselfIsShownWhereItWas) {
  const SwingingRig rig;
  const Problem problem = swinging_problem("{csv: data.csv}", "  residual: motion\n");
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  IdentificationResult result;
  result.parameters = {0.3, 0.4};
  result.x = Eigen::Vector2d(0.3, 0.4);
  result.data.resize(2);
  result.data[0].joint = "hinge/position";
  result.data[1].joint = "hinge/velocity";
  FittedSeries& series = result.data_series;
  series.lengths = {250};
  series.recorded.resize(250, 2);
  for (Eigen::Index row = 0; row < 250; ++row) {
    series.times.push_back(0.02 * static_cast<double>(row));
    series.recorded.row(row) << rig.position(series.times.back()),
        rig.velocity(series.times.back());
  }
  series.computed = series.recorded.rowwise() + Eigen::RowVector2d(0.1, 0.2);
  const ComparedMotion motion = compare_motion(problem, recordings, result, kRate);
  ASSERT_EQ(motion.recordings.size(), 1U);
  const ComparedRecording& recording = motion.recordings[0];
  ASSERT_TRUE(recording.status.ok()) << recording.status.cause;
  ASSERT_EQ(recording.model.size(), 84U) << "every third row: 20 a second were asked for";
  for (std::size_t k = 0; k < recording.model.size(); ++k) {
    const Frame &model = recording.model[k], &measured = recording.measured[k];
    const double t = 0.06 * static_cast<double>(k);
    ASSERT_NEAR(model.time, t, 1e-12);
    EXPECT_NEAR(measured.joints[0].position, rig.position(t), 1e-9);
    EXPECT_NEAR(model.joints[0].position, rig.position(t) + 0.1, 1e-9);
    EXPECT_NEAR(model.joints[0].velocity, rig.velocity(t) + 0.2, 1e-9);
    EXPECT_NEAR(model.joints[0].effort, rig.torque(t), 1e-9) << "the recorded effort was applied";
    EXPECT_NEAR(model.links[1].orientation.angularDistance(measured.links[1].orientation), 0.1,
                1e-9);
  }
}

TEST(CompareMotion, WhatCannotBeShownIsToldByTheStatus) {
  const Problem problem = swinging_problem();
  StudyRecordings recordings;
  recordings.data = {SwingingRig().record("identify.data[0]")};
  recordings.data[0].joints[0].joint = "elbow";
  IdentificationResult result;
  result.parameters = {0.3, 0.4};
  const ComparedMotion motion = compare_motion(problem, recordings, result, kRate);
  ASSERT_EQ(motion.recordings.size(), 1U);
  EXPECT_FALSE(motion.recordings[0].status.ok());
  EXPECT_NE(motion.recordings[0].status.cause.find("elbow"), std::string::npos)
      << motion.recordings[0].status.cause;
  EXPECT_TRUE(motion.recordings[0].model.empty());
}

TEST(CompareMotion, EndsEarlyWhenToldTo) {
  int asked = 0;
  const ComparedMotion motion = Compared(SwingingRig(), "", [&] { return ++asked > 10; }).motion;
  ASSERT_EQ(motion.recordings.size(), 2U);
  EXPECT_EQ(motion.recordings[0].status.code, StatusCode::kCancelled);
  EXPECT_NEAR(motion.recordings[0].status.time, 0.52, 1e-9);
  EXPECT_EQ(motion.recordings[0].model.size(), 10U);
  EXPECT_EQ(motion.recordings[0].measured.size(), 10U);
  EXPECT_EQ(motion.recordings[1].status.code, StatusCode::kCancelled);
  EXPECT_TRUE(motion.recordings[1].model.empty());
}

}  // namespace
}  // namespace codesign
