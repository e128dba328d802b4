// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/unit_check.h"

#include "recordings/some_recording.h"

namespace codesign {
namespace {

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
  for (std::size_t k = 0; k < 300; ++k) recording.joints[0].velocity[k] = std::sin(3.3 * recording.times[k]);
  expect_word(warnings_of(recording).at(0).message, "the velocity of wheel is: columns are exchanged");
  recording.joints.pop_back();
  expect_word(warnings_of(recording).at(0).message, "is not the derivative of its position (correlation");
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
