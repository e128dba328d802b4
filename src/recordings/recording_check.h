// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "description/robot.h"
#include "mechanism_codesign/warning.h"
#include "recordings/joint_recording.h"

namespace codesign {

/// A pause between two samples counts as a gap if it is longer than this many median periods;
/// shorter pauses are interpolated.
constexpr double kGapPeriods = 5.0;
/// The least number of samples of a recording.
constexpr std::size_t kLeastSamples = 20;

/// The samples with `from` <= t <= `to`. Numbers must be finite and times must ascend only in this
/// part.
/// @throws InputError with the place of a number that is not finite, of a time that repeats or
/// jumps back, and if fewer than kLeastSamples samples are left.
JointRecording checked_part(const JointRecording& recording, double from, double to);

/// The recording in pieces without gaps. With GapRule::kSplit, pieces of fewer than kLeastSamples
/// samples are left out, with the warning `recording_piece_dropped`; interpolated pauses of more
/// than 1.5 periods give `recording_samples_missing`.
/// @param has_rule whether an entry of a study can say `gaps: split`, as the message then suggests.
/// @throws InputError with the place of the first gap for GapRule::kRefuse, or if nothing is left.
std::vector<JointRecording> without_gaps(const JointRecording& recording, GapRule rule,
                                         Warnings* warnings, bool has_rule = true);

/// Warns of single samples, three in a row at most, far outside the range of all others:
/// `recording_spike`, with the first one's place. @param cancel ends it before the next column;
/// null: never
void check_spikes(const JointRecording& recording, Warnings* warnings,
                  const std::atomic<bool>* cancel = nullptr);

/// Adds whole turns to the positions of turning joints where they jump by more than half a turn
/// between two samples, as encoders that count from -pi to pi do; warning `recording_unwrapped`.
void unwrap_turns(const RobotDescription& robot, JointRecording* recording, Warnings* warnings);

/// The median of the periods between the times [s]. @param times at least two
double median_period(const std::vector<double>& times);

/// Warns of values that seem to have other units or to stand in other columns: `recording_units` if
/// a measured velocity is not the derivative of the position but nearly proportional to it,
/// `recording_velocity` if it has little to do with it, and `recording_beyond_limits` if positions
/// lie far outside the joint's `<limit>`.
void check_units(const RobotDescription& robot, const JointRecording& recording,
                 Warnings* warnings);

}  // namespace codesign
