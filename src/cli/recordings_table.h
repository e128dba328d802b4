// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_RECORDINGS_TABLE_H_
#define MECHANISM_CODESIGN_CLI_RECORDINGS_TABLE_H_

#include <ostream>
#include <vector>

#include "cli/console.h"
#include "jobs/recording_records.h"

namespace codesign::cli {

/// Reads and filters the recordings of the study's `identify:`; none without one. Relative paths count from the study's folder.
/// @param warnings gets those of the recordings. @throws InputError as load_recordings() and measured_motion().
std::vector<RecordingSummary> check_recordings(const Problem& problem, const Console& console, Warnings* warnings);

/// A row per recording, and what each holds.
void print_recordings(const std::vector<RecordingSummary>& recordings, std::ostream& out);

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_RECORDINGS_TABLE_H_
