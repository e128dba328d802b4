// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cli/console.h"
#include "jobs/recording_records.h"
#include "recordings/joint_recording.h"

namespace codesign::cli {

/// Reads the recordings of the study, which has a block `identify`. Relative paths count from the
/// study's folder. @throws InputError as load_recordings().
StudyRecordings read_recordings(const Problem& problem, const Console& console, Warnings* warnings);

/// Reads and filters the recordings of the study's `identify:`; empty without `identify:`. @param
/// warnings receives the warnings about the recordings. @throws InputError as load_recordings() and
/// measured_motion().
std::vector<RecordingSummary> check_recordings(const Problem& problem, const Console& console,
                                               Warnings* warnings);

/// Prints a row per recording with its content.
void print_recordings(const std::vector<RecordingSummary>& recordings, std::ostream& out);

}  // namespace codesign::cli
