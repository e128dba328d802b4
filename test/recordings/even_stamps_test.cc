// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/even_stamps.h"

#include <cmath>

#include "recordings/some_recording.h"

namespace codesign {
namespace {

/// Jitter of sample k [s], up to 1 ms, which looks like noise.
double jitter(std::size_t k) { return 1e-3 * std::sin(7.0 * static_cast<double>(k * k)); }

/// The motion at the times where samples are taken, and the times that the recording says.
JointRecording stamped(std::size_t count, bool samples_jitter, bool stamps_jitter) {
  JointRecording recording = swing(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double even = recording.times[k], jittered = even + jitter(k),
                 taken = samples_jitter ? jittered : even;
    recording.joints[0].position[k] =
        0.5 * std::sin(2.0 * taken) + 1e-5 * std::sin(11.0 * static_cast<double>(k * k));
    if (stamps_jitter) recording.times[k] = jittered;
  }
  return recording;
}

TEST(EvenStamps, MovesStampsThatJitterAlone) {
  JointRecording recording = stamped(400, false, true);
  Warnings warnings;
  even_stamps(&recording, &warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "recording_even_stamps");
  for (std::size_t k = 0; k < 400; ++k)
    ASSERT_NEAR(recording.times[k], 0.01 * static_cast<double>(k), 1.5e-4) << k;
}

TEST(EvenStamps, LeavesStampsOfSamplesThatJitter) {
  JointRecording recording = stamped(400, true, true);
  const std::vector<double> times = recording.times;
  Warnings warnings;
  even_stamps(&recording, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(recording.times, times);
}

TEST(EvenStamps, LeavesWhatIsEvenAndWhatTellsNothing) {
  JointRecording even = stamped(400, false, false);
  JointRecording still = stamped(400, false, true);
  for (double& position : still.joints[0].position) position = 0.3;
  const std::vector<double> even_times = even.times, still_times = still.times;
  Warnings warnings;
  even_stamps(&even, &warnings);
  even_stamps(&still, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(even.times, even_times);
  EXPECT_EQ(still.times, still_times);
}

TEST(EvenStamps, CountsMissingSamples) {
  JointRecording recording = stamped(400, false, true);
  const auto drop = [](auto* values) {
    values->erase(values->begin() + 100, values->begin() + 102);
  };
  drop(&recording.times);
  drop(&recording.places);
  drop(&recording.joints[0].position);
  drop(&recording.joints[0].velocity);
  drop(&recording.joints[0].effort);
  Warnings warnings;
  even_stamps(&recording, &warnings);
  EXPECT_EQ(warnings.size(), 1U);
  EXPECT_NEAR(recording.times[99], 0.99, 1.5e-4);
  EXPECT_NEAR(recording.times[100], 1.02, 1.5e-4);
}

// Stamps are never early, mostly a little late, and now and then by more than a step.
TEST(EvenStamps, StampsThatAreLateAreNoMissingSamples) {
  JointRecording recording = stamped(400, false, false);
  for (std::size_t k = 0; k < 400; ++k)
    recording.times[k] +=
        k % 57 == 20 ? 0.0098 : 1e-3 * std::abs(std::sin(7.0 * static_cast<double>(k * k)));
  recording.times[100] += 0.006;
  recording.times[101] += 0.0062;
  Warnings warnings;
  even_stamps(&recording, &warnings);
  EXPECT_EQ(warnings.size(), 1U);
  for (std::size_t k = 1; k < 400; ++k)
    ASSERT_NEAR(recording.times[k] - recording.times[k - 1], 0.01, 1e-5) << k;
}

// 300 Hz with stamps in whole milliseconds: 3, 7, 10, ... ms.
TEST(EvenStamps, UndoesTheRoundingOfStamps) {
  JointRecording recording = swing(600);
  for (std::size_t k = 0; k < 600; ++k) {
    const double t = static_cast<double>(k) / 300.0;
    recording.times[k] = 1e-3 * std::round(1e3 * t);
    recording.joints[0].position[k] = 0.5 * std::sin(2.0 * t);
  }
  Warnings warnings;
  even_stamps(&recording, &warnings);
  EXPECT_EQ(warnings.size(), 1U);
  for (std::size_t k = 0; k < 600; ++k)
    ASSERT_NEAR(recording.times[k], static_cast<double>(k) / 300.0, 2e-5) << k;
}

}  // namespace
}  // namespace codesign
