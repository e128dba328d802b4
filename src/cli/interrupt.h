// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_INTERRUPT_H_
#define MECHANISM_CODESIGN_CLI_INTERRUPT_H_

#include <atomic>

namespace codesign::cli {

/// Makes the first SIGINT or SIGTERM set interrupted() and the second end the program.
void watch_interrupts();

const std::atomic<bool>& interrupted();

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_INTERRUPT_H_
