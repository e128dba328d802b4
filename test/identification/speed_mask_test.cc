// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Samples at which a joint is slow do not count: friction at rest is any value up to breakaway.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "identification/effort/effort_doubts.h"
#include "identification/effort/effort_residuals.h"
#include "identification/identify.h"
#include "identification/swinging_arm.h"

namespace codesign {
namespace {

constexpr double kMoving = 1.0, kResting = 0.6;  // [s] of each in turn

/// The fraction of a second of moving within time t, and whether the joint moves there.
double moved_at(double t, bool* moves) {
  const double cycle = std::floor(t / (kMoving + kResting)),
               within = t - cycle * (kMoving + kResting);
  *moves = within < kMoving;
  return cycle * kMoving + std::min(within, kMoving);
}

/// The arm with inertia 0.3 and viscous 0.4 moves there and back, by a fourth power of a sine,
/// which begins and ends smoothly, and rests in between; there dry friction takes efforts of any
/// value.
JointRecording recording_with_rests(double least_speed) {
  constexpr double kPi = 3.14159265358979323846;
  JointRecording recording = SwingingRig().record("identify.data[0]");
  JointSamples& hinge = recording.joints[0];
  for (std::size_t k = 0; k < recording.times.size(); ++k) {
    bool moves = false;
    const double w = kPi / kMoving, s = w * moved_at(recording.times[k], &moves);
    const double sine = std::sin(s), cosine = std::cos(s);
    hinge.position[k] = 0.25 * std::pow(sine, 4);
    hinge.velocity[k] = moves ? w * std::pow(sine, 3) * cosine : 0.0;
    const double acceleration =
        moves ? w * w * (3.0 * sine * sine * cosine * cosine - std::pow(sine, 4)) : 0.0;
    hinge.effort[k] = moves ? 0.8 * acceleration + 0.4 * hinge.velocity[k]
                            : 3.0 * std::sin(0.7 * static_cast<double>(k));
  }
  hinge.least_speed = least_speed;
  return recording;
}

IdentificationResult fit_of_rests(const std::string& filter, double least_speed) {
  StudyRecordings recordings;
  recordings.data = {recording_with_rests(least_speed)};
  return identify(swinging_problem("{csv: data.csv}", "  filter: {" + filter + "}\n"), recordings,
                  {}, nullptr);
}

TEST(SpeedMask, RestsDoNotCount) {
  const IdentificationResult all = fit_of_rests("cutoff: 0", 0.0),
                             moving = fit_of_rests("cutoff: 0", 0.05);
  ASSERT_EQ(moving.data.size(), 1U);
  EXPECT_EQ(all.data[0].counted, 1.0);
  EXPECT_NEAR(moving.data[0].counted, kMoving / (kMoving + kResting), 0.15);
  EXPECT_LT(moving.data[0].rms, 0.1 * all.data[0].rms);
  ASSERT_TRUE(moving.status.ok()) << moving.status.cause;
  // The difference of samples at the begin of a motion is not exact.
  EXPECT_NEAR(moving.numbers[0].value, 0.3, 2e-3);
  EXPECT_NEAR(moving.numbers[1].value, 0.4, 2e-3);
  EXPECT_GT(moving.data[0].explained, 0.999);
  EXPECT_LT(all.data[0].explained, 0.9);
}

/// A filter spreads the efforts at rest over the begin of a motion, unless they are left out before
/// it.
TEST(SpeedMask, AFilterSpreadsNothingOfARest) {
  const IdentificationResult moving =
      fit_of_rests("cutoff: 0, residual_cutoff: 15, decimate: 2", 0.05);
  ASSERT_TRUE(moving.status.ok()) << moving.status.cause;
  EXPECT_NEAR(moving.numbers[0].value, 0.3, 2e-3);
  EXPECT_NEAR(moving.numbers[1].value, 0.4, 2e-3);
}

TEST(SpeedMask, DeviationsAreThoseOfTheSamplesThatCount) {
  const Problem problem = swinging_problem("{csv: data.csv}", "  filter: {cutoff: 0}\n");
  const FitVariables variables(study_of(problem), &robot_of(problem));
  const std::vector<JointRecording> recordings = {recording_with_rests(0.05)};
  Warnings warnings;
  EffortResiduals residuals(*system_of(problem), variables, require_same_joints(recordings),
                            {measured_motion(recordings[0], {}, &warnings)}, {}, 1);
  const Eigen::MatrixXd counted = residuals.counted();
  ASSERT_EQ(counted.rows(), residuals.rows());
  ASSERT_TRUE(residuals.begin(variables.start()).ok());
  Eigen::MatrixXd values, slopes;
  ASSERT_TRUE(residuals.evaluate(variables.start(), &values, &slopes).ok());
  for (Eigen::Index k = 0; k < counted.rows(); ++k) {
    const double speed =
        std::abs(recordings[0].joints[0].velocity[static_cast<std::size_t>(k) + 4]);
    EXPECT_EQ(counted(k, 0), speed < 0.05 ? 0.0 : 1.0);
    if (counted(k, 0) != 0.0) continue;
    EXPECT_EQ(values(k, 0), 0.0);
    EXPECT_TRUE(slopes.row(k).isZero(0.0));
  }
}

TEST(SpeedMask, DoubtsCountWhatMoves) {
  const Problem problem = swinging_problem("{csv: data.csv}", "  filter: {cutoff: 0}\n");
  std::vector<JointRecording> recordings = {recording_with_rests(0.05)};
  EXPECT_TRUE(find_effort_doubts(problem, recordings).empty());
  for (double& effort : recordings[0].joints[0].effort) effort = -effort;
  const std::vector<EffortDoubt> doubts = find_effort_doubts(problem, recordings);
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_EQ(doubts[0].mistake, "with the other sign");
}

/// The recording that has the mask is named, not the first one.
TEST(SpeedMask, AJointThatNeverMovesSoFastIsRefused) {
  StudyRecordings recordings;
  recordings.holdout = {recording_with_rests(0.05), recording_with_rests(50.0)};
  recordings.holdout[1].element = "identify.holdout[1]";
  recordings.holdout[1].where = {"study.yaml", 7};
  recordings.data = {recordings.holdout[1]};
  recordings.data[0].element = "identify.data[3]";
  try {
    identify(swinging_problem("{csv: data.csv}", "  filter: {cutoff: 0}\n"), recordings, {},
             nullptr);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().element, "identify.data[3].mask.speed") << error.what();
    EXPECT_EQ(error.fault().where.line, 7);
  }
}

/// The samples of all recordings count together, also of those with values of their own.
TEST(SpeedMask, RecordingsWithValuesOfTheirOwnCountTogether) {
  const Problem problem = load_problem(
      {"arm.urdf", kSwingingArm}, {},
      {"study.yaml",
       "identify: {data: [{csv: a.csv}], filter: {cutoff: 0}}\nparameters: {inertia: {}}\n"});
  StudyRecordings recordings;
  recordings.data = {recording_with_rests(0.05), recording_with_rests(50.0)};
  recordings.data[0].settings = {{1, 0.4}};
  recordings.data[1].settings = {{1, 0.5}};
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.numbers[0].value, 0.3, 2e-3);
}

/// A mask that leaves few samples leaves hardly any of those by which a finished fit is doubted.
TEST(SpeedMask, AFitOfFewFastSamplesIsKept) {
  JointRecording recording = SwingingRig().record("identify.data[0]");
  const auto fast = [&](double speed) {
    return std::count_if(recording.joints[0].velocity.begin(), recording.joints[0].velocity.end(),
                         [speed](double v) { return std::abs(v) >= speed; });
  };
  double speed = 3.5;
  while (fast(speed) < 30) speed -= 0.01;
  ASSERT_LT(fast(speed), 40) << "every second sample counts for doubts";
  recording.joints[0].least_speed = speed;
  StudyRecordings recordings;
  recordings.data = {recording};
  const Problem problem = swinging_problem("{csv: data.csv}", "  filter: {cutoff: 0}\n");
  const IdentificationResult result = identify(problem, recordings, {}, nullptr);
  EXPECT_EQ(result.data.size(), 1U);
  EXPECT_NEAR(result.numbers[1].value, 0.4, 2e-2);
  EXPECT_TRUE(find_effort_doubts(problem, recordings.data).empty());
  recordings.data[0].joints[0].least_speed = 3.6;
  EXPECT_THROW(find_effort_doubts(problem, recordings.data), InputError);
}

}  // namespace
}  // namespace codesign
