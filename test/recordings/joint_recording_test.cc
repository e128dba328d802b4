// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "recordings/joint_recording.h"

#include "recordings/some_recording.h"

namespace codesign {
namespace {

TEST(JointRecording, FindsJointsAndPlaces) {
  JointRecording recording = swing(5);
  ASSERT_NE(recording.find("hinge"), nullptr);
  EXPECT_EQ(recording.find("wheel"), nullptr);
  EXPECT_EQ(recording.place_of(3), "line 5, t = 0.03 s");
  EXPECT_EQ(recording.location_of(3).line, 5);
  recording.topic = "/joint_states";
  EXPECT_EQ(recording.place_of(3), "message 5, t = 0.03 s");
  EXPECT_EQ(recording.location_of(3).line, 0);
}

TEST(JointRecording, APartKeepsWhatWasNotMeasuredEmpty) {
  JointRecording recording = swing(10);
  recording.joints[0].effort.clear();
  const JointRecording part = part_of(recording, 2, 6);
  EXPECT_EQ(part.times, (std::vector<double>{0.02, 0.03, 0.04, 0.05}));
  EXPECT_EQ(part.places.front(), 4U);
  EXPECT_EQ(part.joints[0].position.size(), 4U);
  EXPECT_EQ(part.joints[0].position[1], recording.joints[0].position[3]);
  EXPECT_TRUE(part.joints[0].effort.empty());
  EXPECT_EQ(part.file, "swing.csv");
  EXPECT_EQ(part.element, "identify.data[0]");
}

}  // namespace
}  // namespace codesign
