// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace codesign::cli {

/// Until keep_results() is called, SIGINT and SIGTERM end the program at once with exit code
/// kFailed.
void watch_interrupts();

/// From now on the first SIGINT or SIGTERM sets interrupted(), and a second one ends the program.
/// Called when there are results to keep.
void keep_results();

/// Whether the program was interrupted after keep_results().
const std::atomic<bool>& interrupted();

}  // namespace codesign::cli
