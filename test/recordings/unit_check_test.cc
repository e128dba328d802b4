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
