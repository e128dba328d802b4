// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "recordings/recording_check.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

InputFault part_fault(const JointRecording& recording, double from = -kNever, double to = kNever) {
  return refusal_of([&] { checked_part(recording, from, to); });
}

TEST(CheckedPart, CutsOutTheRange) {
  const JointRecording part = checked_part(swing(100), 0.2, 0.5);
  EXPECT_EQ(part.times.size(), 31U);
  EXPECT_NEAR(part.times.front(), 0.2, 1e-12);
  EXPECT_NEAR(part.times.back(), 0.5, 1e-12);
  EXPECT_EQ(part.places.front(), 22U);
}

TEST(CheckedPart, NamesTheNumberThatIsNone) {
  JointRecording recording = swing(100);
  recording.joints[0].velocity[70] = std::nan("");
  const InputFault fault = part_fault(recording);
  expect_word(fault.message, "the velocity of hinge is not a finite number (line 72, t = 0.7 s)");
  EXPECT_EQ(fault.where.file, "swing.csv");
  EXPECT_EQ(fault.where.line, 72);
  EXPECT_EQ(fault.element, "identify.data[0]");
  EXPECT_EQ(checked_part(recording, 0.0, 0.6).times.size(), 61U);
  recording.times[50] = kNever;
  expect_word(part_fault(recording).message, "the time is not a finite number");
}

TEST(CheckedPart, NamesTheClockThatJumps) {
  JointRecording recording = swing(100);
  recording.times[60] = recording.times[59];
  expect_word(part_fault(recording).message,
              "the time equals the time of the previous sample (line 62");
  for (std::size_t k = 60; k < 100; ++k) recording.times[k] = 0.01 * static_cast<double>(k) - 0.3;
  expect_word(part_fault(recording).message, "the time jumps back by 0.29 s");
  expect_word(part_fault(recording).message, "line 62");
}

TEST(CheckedPart, SaysWhatTheRecordingHolds) {
  const InputFault fault = part_fault(swing(100), 7.0, 37.0);
  expect_word(fault.message,
              "0 samples from 7 s to 37 s; the recording reaches from 0 s to 0.99 s");
  EXPECT_EQ(fault.where.line, 4);
  expect_word(part_fault(swing(100), 0.5, 0.6).message, "11 samples");
  expect_word(part_fault(JointRecording()).message, "the recording is empty");
}

/// Samples 40 and later come `seconds` later.
JointRecording paused(double seconds) {
  JointRecording recording = swing(100);
  for (std::size_t k = 40; k < 100; ++k) recording.times[k] += seconds;
  return recording;
}

TEST(WithoutGaps, RefusesAGapAndNamesItsPlace) {
  Warnings warnings;
  const InputFault fault =
      refusal_of([&] { without_gaps(paused(3.0), GapRule::kRefuse, &warnings); });
  expect_word(fault.message, "a gap of 3.01 s, where the period is 0.01 s");
  expect_word(fault.message, "line 42");
  expect_word(fault.allowed, "gaps: split");
  // No entry of a study describes it.
  const InputFault alone =
      refusal_of([&] { without_gaps(paused(3.0), GapRule::kRefuse, &warnings, false); });
  EXPECT_EQ(alone.allowed, "pauses of at most 5 periods");
  EXPECT_EQ(without_gaps(swing(100), GapRule::kRefuse, &warnings).size(), 1U);
  EXPECT_TRUE(warnings.empty());
}

TEST(WithoutGaps, SplitsOnRequest) {
  Warnings warnings;
  const std::vector<JointRecording> pieces = without_gaps(paused(3.0), GapRule::kSplit, &warnings);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].times.size(), 40U);
  EXPECT_EQ(pieces[1].places.front(), 42U);
  EXPECT_TRUE(warnings.empty());
  JointRecording stub = paused(3.0);
  for (std::size_t k = 90; k < 100; ++k) stub.times[k] += 3.0;
  EXPECT_EQ(without_gaps(stub, GapRule::kSplit, &warnings).size(), 2U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_piece_dropped");
  expect_word(warnings[0].message, "a piece of 10 samples");
}

TEST(WithoutGaps, AFewMissingSamplesAreToldAndInterpolated) {
  Warnings warnings;
  EXPECT_EQ(without_gaps(paused(0.02), GapRule::kRefuse, &warnings).size(), 1U);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_samples_missing");
  expect_word(warnings[0].message, "1 pauses are longer than 1.5 periods of 0.01 s");
  EXPECT_EQ(warnings[0].where.line, 42);
}

TEST(UnwrapTurns, AddsWholeTurnsToTurningJoints) {
  const double turn = 2.0 * 3.14159265358979323846;
  JointRecording recording = swing(100);
  recording.joints.push_back(recording.joints[0]);
  recording.joints[1].joint = "slider";
  JointRecording straight = recording;
  for (JointSamples& samples : straight.joints)
    for (std::size_t k = 0; k < 100; ++k) samples.position[k] = 0.1 * static_cast<double>(k);
  JointRecording wrapped = straight;
  for (JointSamples& samples : wrapped.joints)
    for (double& position : samples.position) position = std::remainder(position, turn);
  Warnings warnings;
  const std::vector<double> slider = wrapped.joints[1].position;
  unwrap_turns(recorded_robot(), &wrapped, &warnings);
  for (std::size_t k = 0; k < 100; ++k)
    ASSERT_NEAR(wrapped.joints[0].position[k], straight.joints[0].position[k], 1e-12) << k;
  EXPECT_EQ(wrapped.joints[1].position, slider);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_unwrapped");
  expect_word(warnings[0].message, "2 times, first at line 34");
}

TEST(MedianPeriod, IgnoresAPause) {
  EXPECT_DOUBLE_EQ(median_period({0.0, 1.0, 2.0, 9.0, 10.0}), 1.0);
}

Warnings spikes_in(const JointRecording& recording) {
  Warnings warnings;
  check_spikes(recording, &warnings);
  return warnings;
}

TEST(SpikeCheck, ASpikeIsNamedByFileRowAndJoint) {
  JointRecording recording = swing(300);
  recording.joints[0].effort[77] = 5000.0;
  const Warnings warnings = spikes_in(recording);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_spike");
  EXPECT_EQ(warnings[0].where.file, "swing.csv");
  EXPECT_EQ(warnings[0].where.line, 79);
  expect_word(warnings[0].message,
              "the effort of hinge jumps to 5000 and back (line 79, t = 0.77 s)");
  recording.joints[0].effort[200] = -400.0;
  expect_word(spikes_in(recording).at(0).message, "one of 2 such samples");
}

TEST(SpikeCheck, ACancelEndsItBeforeTheNextColumn) {
  JointRecording recording = swing(300);
  recording.joints[0].effort[77] = 5000.0;
  Warnings warnings;
  const std::atomic<bool> cancel{true};
  check_spikes(recording, &warnings, &cancel);
  EXPECT_TRUE(warnings.empty());
}

TEST(SpikeCheck, JumpsNoiseRestAndStepsOfAnEncoderAreNone) {
  JointRecording recording = swing(300);
  EXPECT_TRUE(spikes_in(recording).empty());
  JointSamples& hinge = recording.joints[0];
  for (std::size_t k = 0; k < 300; ++k) {
    hinge.effort[k] = (k < 150 ? 1.0 : -20.0) + 0.1 * static_cast<double>(k * 7919 % 13);
    hinge.position[k] = k % 50 == 0 ? 1e-4 : 0.0;
    hinge.velocity[k] = k < 140 || k > 160 ? 0.0 : std::sin(0.157 * static_cast<double>(k - 140));
  }
  EXPECT_TRUE(spikes_in(recording).empty());
}

Warnings warnings_of(const JointRecording& recording) {
  Warnings warnings;
  check_units(recorded_robot(), recording, &warnings);
  return warnings;
}

void scale(std::vector<double>* column, double factor) {
  for (double& value : *column) value *= factor;
}

TEST(UnitCheck, SaysNothingOfAPlausibleRecording) { EXPECT_TRUE(warnings_of(swing(300)).empty()); }

TEST(UnitCheck, NoticesAVelocityInOtherUnits) {
  JointRecording recording = swing(300);
  scale(&recording.joints[0].velocity, 180.0 / 3.14159265358979323846);
  const Warnings warnings = warnings_of(recording);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_units");
  expect_word(warnings[0].message, "the velocity of hinge is 57.3");
  EXPECT_EQ(warnings[0].where.line, 4);
  scale(&recording.joints[0].velocity, -1.0);
  expect_word(warnings_of(recording).at(0).message, "is -57.3");
}

/// As swing(), with a second wave, so that derivatives are no longer proportional.
JointRecording two_waves() {
  JointRecording recording = swing(300);
  for (std::size_t k = 0; k < 300; ++k) {
    const double t = recording.times[k];
    recording.joints[0].position[k] = 0.4 * std::sin(2.0 * t) + 0.2 * std::sin(5.0 * t);
    recording.joints[0].velocity[k] = 0.8 * std::cos(2.0 * t) + 1.0 * std::cos(5.0 * t);
  }
  return recording;
}

TEST(UnitCheck, NoticesExchangedColumns) {
  JointRecording recording = two_waves();
  EXPECT_TRUE(warnings_of(recording).empty());
  std::swap(recording.joints[0].position, recording.joints[0].velocity);
  const Warnings exchanged = warnings_of(recording);
  ASSERT_FALSE(exchanged.empty());
  EXPECT_EQ(exchanged[0].code, "recording_velocity");
  expect_word(exchanged[0].message, "the two columns are exchanged");
  recording = two_waves();
  recording.joints.push_back({"wheel", {}, recording.joints[0].velocity, {}});
  for (std::size_t k = 0; k < 300; ++k)
    recording.joints[0].velocity[k] = std::sin(3.3 * recording.times[k]);
  expect_word(warnings_of(recording).at(0).message,
              "the velocity of wheel is: columns are exchanged");
  recording.joints.pop_back();
  expect_word(warnings_of(recording).at(0).message,
              "is not the derivative of its position (correlation");
}

TEST(UnitCheck, AVelocityOfNoiseTellsNothingAboutUnits) {
  JointRecording recording = swing(300);
  for (std::size_t k = 0; k < 300; ++k) recording.joints[0].velocity[k] = k % 2 == 0 ? 1.0 : -1.0;
  EXPECT_TRUE(warnings_of(recording).empty());
}

TEST(UnitCheck, NoticesDegreesByTheLimits) {
  JointRecording recording = swing(300);
  recording.joints[0].velocity.clear();
  scale(&recording.joints[0].position, 180.0 / 3.14159265358979323846);
  const Warnings warnings = warnings_of(recording);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_beyond_limits");
  expect_word(warnings[0].message, "[-1, 1] in rad or m");
}

}  // namespace

}  // namespace codesign
