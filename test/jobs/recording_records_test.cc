// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/recording_records.h"

#include "jobs/json.h"
#include "recordings/some_recording.h"

namespace codesign {
namespace {

TEST(RecordingRecords, TellWhatARecordingHolds) {
  JointRecording recording = swing(400);
  recording.joints[0].velocity.clear();
  FilterOptions filter;
  filter.cutoff = 10.0;
  filter.decimate = 2;
  Warnings warnings;
  const RecordingSummary summary = summary_of(recording, measured_motion(recording, filter, &warnings));
  EXPECT_EQ(summary.samples, 400U);
  EXPECT_NEAR(summary.rate, 100.0, 1e-9);
  EXPECT_EQ(summary.fitted, 176);
  EXPECT_EQ(summary.measured, (std::vector<std::string>{"hinge/position", "hinge/effort"}));
  const Json list = to_json(std::vector<RecordingSummary>{summary});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0]["recording"], "identify.data[0]");
  EXPECT_EQ(list[0]["file"], "swing.csv");
  EXPECT_EQ(list[0]["to"], 3.99);
  EXPECT_EQ(list[0]["measured"][1], "hinge/effort");
}

}  // namespace
}  // namespace codesign
