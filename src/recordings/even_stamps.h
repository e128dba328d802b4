// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Puts the times of a recording on equal steps if its motion says that the samples were taken
/// there and only their stamps jitter; doc/theory.md (30a). Missing samples stay missing. Warning
/// `recording_even_stamps`. Otherwise nothing changes.
/// @param recording with ascending times, turns unwrapped
void even_stamps(JointRecording* recording, Warnings* warnings);

}  // namespace codesign
