// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_INTERRUPT_H_
#define MECHANISM_CODESIGN_CLI_INTERRUPT_H_

#include <atomic>

namespace codesign::cli {

/// Until something is there to keep, SIGINT and SIGTERM end the program at once, with the exit code of a failure.
void watch_interrupts();

/// From now on the first of them sets interrupted(), and the second ends the program.
void keep_results();

const std::atomic<bool>& interrupted();

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_INTERRUPT_H_
