// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "cli/console.h"

namespace codesign::cli {
namespace {

std::atomic<bool> interrupted_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");

// While the input is loaded, no flag is checked and there are no results to lose, so that the
// program ends at once.
extern "C" void leave(int) {
  static const char kMessage[] = "codesign: interrupted before anything was computed\n";
  const ssize_t written = write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
  static_cast<void>(written);  // there is nobody else to tell
  _exit(kFailed);
}

extern "C" void on_interrupt(int signal_number) {
  interrupted_flag = true;
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void watch_interrupts() {
  std::signal(SIGINT, leave);
  std::signal(SIGTERM, leave);
  // A file that becomes larger than the limit (ulimit -f) is an error of the write, as a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

void keep_results() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

const std::atomic<bool>& interrupted() { return interrupted_flag; }

}  // namespace codesign::cli
