// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/measured_motion.h"

#include "recordings/some_recording.h"

namespace codesign {
namespace {

FilterOptions filter_of(double cutoff, int decimate = 1) {
  FilterOptions filter;
  filter.cutoff = cutoff;
  filter.residual_cutoff = cutoff;
  filter.decimate = decimate;
  filter.where = {"study.yaml", 6};
  return filter;
}

// x = 0.5 sin(2 t): the velocity and the acceleration are known, and 10 Hz is far above 2 rad/s.
void expect_swing(const MeasuredMotion& motion, double tolerance) {
  const JointMotion& joint = motion.joints.at(0);
  for (Eigen::Index k = motion.first; k < motion.end; k += motion.every) {
    const double t = motion.times.at(k);
    ASSERT_NEAR(joint.position[k], 0.5 * std::sin(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.velocity[k], std::cos(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.acceleration[k], -2.0 * std::sin(2.0 * t), tolerance) << t;
    ASSERT_NEAR(joint.effort[k], 3.0 * std::sin(2.0 * t), tolerance) << t;
  }
}

TEST(MeasuredMotion, DerivesWhatWasNotMeasured) {
  JointRecording recording = swing(400);
  recording.joints[0].velocity.clear();
  Warnings warnings;
  const MeasuredMotion motion = measured_motion(recording, filter_of(10.0), &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_FALSE(motion.joints[0].velocity_measured);
  EXPECT_EQ(motion.first, 44);
  EXPECT_EQ(motion.end, 356);
  EXPECT_EQ(motion.fitted(), 312);
  expect_swing(motion, 3e-4);
}

TEST(MeasuredMotion, TakesTheVelocityThatWasMeasured) {
  Warnings warnings;
  const MeasuredMotion motion = measured_motion(swing(400), filter_of(10.0, 5), &warnings);
  EXPECT_TRUE(motion.joints[0].velocity_measured);
  EXPECT_EQ(motion.every, 5);
  EXPECT_EQ(motion.fitted(), 63);
  expect_swing(motion, 2e-5);
}

TEST(MeasuredMotion, PutsJitteringTimesOnEqualSteps) {
  JointRecording recording = swing(400);
  JointSamples& samples = recording.joints[0];
  for (std::size_t k = 0; k < 400; ++k) {
    const double t = 0.01 * (static_cast<double>(k) + 0.3 * std::sin(7.0 * static_cast<double>(k)));
    recording.times[k] = t;
    samples.position[k] = 0.5 * std::sin(2.0 * t);
    samples.effort[k] = 3.0 * std::sin(2.0 * t);
  }
  samples.velocity.clear();
  Warnings warnings;
  expect_swing(measured_motion(recording, filter_of(10.0), &warnings), 2e-3);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_resampled");
}

TEST(MeasuredMotion, AVelocityAloneGivesAnAcceleration) {
  JointRecording recording = swing(400);
  recording.joints[0].position.clear();
  recording.joints[0].effort.clear();
  Warnings warnings;
  const JointMotion joint = measured_motion(recording, filter_of(10.0), &warnings).joints.at(0);
  EXPECT_EQ(joint.position.size(), 0);
  EXPECT_EQ(joint.effort.size(), 0);
  EXPECT_NEAR(joint.acceleration[200], -2.0 * std::sin(4.0), 1e-5);
}

TEST(MeasuredMotion, WarnsOfNoiseThatGetsThrough) {
  Warnings warnings;
  FilterOptions filter = filter_of(0.0, 4);
  measured_motion(swing(400), filter, &warnings);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0].code, "recording_not_filtered");
  EXPECT_EQ(warnings[1].code, "recording_aliased");
  expect_word(warnings[1].message, "above 12.5 Hz");
  warnings.clear();
  measured_motion(swing(400), filter_of(12.0, 4), &warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(MeasuredMotion, RefusesCutoffsAndLengthsThatCannotBe) {
  Warnings warnings;
  const InputFault cutoff = refusal_of([&] { measured_motion(swing(400), filter_of(50.0), &warnings); });
  EXPECT_EQ(cutoff.element, "identify.filter.cutoff");
  EXPECT_EQ(cutoff.where.line, 6);
  expect_word(cutoff.message, "a recording of 100 samples per second");
  EXPECT_EQ(cutoff.allowed, "less than 50 Hz, or 0 for no filter");
  const InputFault length = refusal_of([&] { measured_motion(swing(60), filter_of(10.0), &warnings); });
  EXPECT_EQ(length.element, "identify.data[0]");
  expect_word(length.message, "60 samples leave 0 to fit");
  for (const double low : {1e-9, 1e-300}) {
    const InputFault none = refusal_of([&] { measured_motion(swing(400), filter_of(low), &warnings); });
    expect_word(none.message, "400 samples leave 0 to fit");
  }
}

TEST(MeasuredMotion, APositionThatWasNotMeasuredIsTheIntegralOfTheVelocity) {
  JointRecording recording = swing(400);
  JointSamples& hinge = recording.joints[0];
  const std::vector<double> truth = hinge.position;
  hinge.position.clear();
  FilterOptions filter;
  filter.cutoff = 10.0;
  Warnings warnings;
  EXPECT_EQ(measured_motion(recording, filter, &warnings).joints[0].position.size(), 0);
  hinge.start.emplace(0.25);
  const MeasuredMotion motion = measured_motion(recording, filter, &warnings);
  EXPECT_EQ(motion.element, "identify.data[0]");
  EXPECT_FALSE(motion.joints[0].position_measured);
  EXPECT_EQ(motion.joints[0].position[0], 0.25);
  // The filter knows one side only at the beginning, which leaves a constant.
  const double off = motion.joints[0].position[motion.first] - truth[static_cast<std::size_t>(motion.first)];
  EXPECT_NEAR(off, 0.25, 2e-4);
  for (Eigen::Index k = motion.first; k < motion.end; ++k)
    EXPECT_NEAR(motion.joints[0].position[k], truth[static_cast<std::size_t>(k)] + off, 1e-6) << k;
}

}  // namespace
}  // namespace codesign
