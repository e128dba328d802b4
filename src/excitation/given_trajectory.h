// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "excitation/excitation_result.h"
#include "excitation/excited_motion.h"
#include "excitation/motion_limits.h"
#include "recordings/joint_recording.h"
#include "recordings/measured_motion.h"

namespace codesign {

/// The motion of a table at equal steps, filtered as recordings are, all samples.
/// @param warnings those of measured_motion() are appended
/// @throws InputError for one of the joints without positions
MeasuredMotion given_motion(const JointRecording& given, const FilterOptions& options,
                            const std::vector<MeasuredJoint>& joints, Warnings* warnings);

/// The motion of these joints. @param motion of given_motion()
DrivePath path_of(const MeasuredMotion& motion, const std::vector<MeasuredJoint>& joints);

/// What a motion reaches at its samples, of all limits.
std::vector<KeptLimit> reached_limits(const MotionLimits& limits, const DrivePath& path,
                                      const PathResponse& response);

}  // namespace codesign
