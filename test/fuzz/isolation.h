// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_TEST_FUZZ_ISOLATION_H_
#define MECHANISM_CODESIGN_TEST_FUZZ_ISOLATION_H_

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace codesign::fuzz {

/// What a run may take. Sanitizers take several times more of both.
struct Limits {
  double cancel_after = 2.0;  ///< seconds of processor time after which the run is cancelled
  double obey_within = 1.0;   ///< and in which it must then end
  long kilobytes = 500000;    ///< of memory; 0: unlimited
};

/// The limits for the way this program was compiled.
Limits default_limits();

/// What is done in a process of its own. Returns what is wrong with the outcome, empty if nothing is. The flag is set when time is up.
using Body = std::function<std::string(const std::atomic<bool>& cancel)>;

/// Runs `body` in a process of its own and returns what is wrong: what the body says, a crash, a sanitizer's report, too much time or
/// memory. @param disk bytes that may be written to any file.
std::string run_isolated(const Body& body, const Limits& limits, std::optional<long> disk = std::nullopt);

}  // namespace codesign::fuzz

#endif  // MECHANISM_CODESIGN_TEST_FUZZ_ISOLATION_H_
