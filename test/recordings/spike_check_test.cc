// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/recording_check.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

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
  expect_word(warnings[0].message, "the effort of hinge jumps to 5000 and back (line 79, t = 0.77 s)");
  recording.joints[0].effort[200] = -400.0;
  expect_word(spikes_in(recording).at(0).message, "one of 2 such samples");
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

}  // namespace
}  // namespace codesign
