// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// identify() by residuals of simulated motion.
#include <gtest/gtest.h>

#include <cmath>

#include "identification/identify.h"
#include "identification/motion_rig.h"

namespace codesign {
namespace {

/// Inertia, damping and dry friction of the pendulum from its recording.
void expect_pendulum(const IdentificationResult& result, double deviations) {
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double truth[] = {0.2, 0.3, 0.5};
  for (std::size_t k = 0; k < 3; ++k) {
    const IdentifiedNumber& number = result.numbers[k];
    EXPECT_GT(number.deviation, 0.0);
    EXPECT_LT(number.deviation, 0.05 * truth[k]) << number.name;
    EXPECT_LT(std::abs(number.value - truth[k]), deviations * number.deviation + 1e-4)
        << number.name;
  }
}

TEST(Identify, InMotionUnderRecordedEfforts) {
  MotionRig rig;
  rig.noise = 0.002;
  StudyRecordings recordings;
  recordings.data = {record_pendulum(rig)};
  recordings.holdout = {record_pendulum(rig)};
  const IdentificationResult result =
      identify(motion_problem("", "  segment: 1.0\n  filter: {cutoff: 20.0}\n",
                              "inertia: {}, viscous: {}, dry: {}"),
               recordings, {}, nullptr);
  expect_pendulum(result, 4.0);
  ASSERT_EQ(result.data.size(), 1U);
  EXPECT_EQ(result.data[0].joint, "hinge/position");
  EXPECT_NEAR(result.data[0].rms, 0.002, 2e-4);
  EXPECT_GT(result.data[0].start, 0.02);
  EXPECT_NEAR(result.holdout[0].rms, 0.002, 2e-4);
}

TEST(Identify, InMotionWithTheControllerInTheLoopAndOutliers) {
  MotionRig rig;
  rig.noise = 0.002;
  rig.with_velocity = true;
  StudyRecordings recordings;
  recordings.data = {record_pendulum(rig)};
  for (std::size_t k = 7; k < recordings.data[0].times.size(); k += 23)
    recordings.data[0].joints[0].position[k] += 0.2;
  const IdentificationResult result =
      identify(motion_problem(motion_servo(),
                              "  segment: 1.5\n  filter: {cutoff: 20.0}\n  loss: {type: huber}\n",
                              "inertia: {}, viscous: {}, dry: {}"),
               recordings, {}, nullptr);
  expect_pendulum(result, 4.0);
  EXPECT_EQ(result.data.size(), 3U);
}

TEST(Identify, InMotionWhatTheDataDoNotTellIsNamed) {
  StudyRecordings recordings;
  MotionRig rig;
  rig.noise = 0.002;
  recordings.data = {record_pendulum(rig)};
  // Without the recorded effort as an input its scale changes nothing.
  for (double& effort : recordings.data[0].joints[0].effort) effort = 0.0;
  const IdentificationResult result = identify(
      motion_problem(motion_servo(), "  segment: 1.5\n  joints: {hinge: {effort_scale: {}}}\n",
                     "inertia: {}, viscous: {}"),
      recordings, {}, nullptr);
  EXPECT_EQ(result.status.code, StatusCode::kNotIdentifiable);
  ASSERT_EQ(result.undetermined.size(), 1U);
  EXPECT_NE(result.undetermined[0].find("hinge/effort_scale"), std::string::npos)
      << result.undetermined[0];
}

}  // namespace
}  // namespace codesign
