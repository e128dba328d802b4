// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_CLI_CONSOLE_H_
#define MECHANISM_CODESIGN_CLI_CONSOLE_H_

#include <atomic>
#include <ostream>

namespace codesign::cli {

/// Where a command speaks, and how it is told to stop.
struct Console {
  std::ostream& out;                ///< results only
  std::ostream& err;                ///< progress and messages
  const std::atomic<bool>& cancel;  ///< set: end soon, keeping what there is
  void (*loaded)() = nullptr;       ///< called once the input is read and set up, before anything is computed
};

/// The program's exit codes.
enum ExitCode : int { kDone = 0, kFailed = 1, kBadInput = 2 };

}  // namespace codesign::cli

#endif  // MECHANISM_CODESIGN_CLI_CONSOLE_H_
