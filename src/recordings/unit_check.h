// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/robot.h"
#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// Warns of values that seem to have other units or to stand in other columns: `recording_units` if a measured velocity is not the
/// derivative of the position but nearly proportional to it, `recording_velocity` if it has little to do with it, and
/// `recording_beyond_limits` if positions lie far outside the joint's `<limit>`.
void check_units(const RobotDescription& robot, const JointRecording& recording, Warnings* warnings);

}  // namespace codesign
