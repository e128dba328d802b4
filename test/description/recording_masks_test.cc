// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/recording_masks.h"

#include <gtest/gtest.h>

#include <string>

namespace codesign {
namespace {

TEST(RecordingMasks, MotionsAreComparedAtRestToo) {
  RecordingDescription recording;
  recording.element = "recordings[1]";
  EXPECT_NO_THROW(refuse_masks_in_motion(recording, ResidualKind::kMotion));
  recording.masks = {{"", 0.1, {"arrays", 0}}};
  EXPECT_NO_THROW(refuse_masks_in_motion(recording, ResidualKind::kEffort));
  try {
    refuse_masks_in_motion(recording, ResidualKind::kMotion);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("recordings[1].mask"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
