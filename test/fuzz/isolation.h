// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace codesign::fuzz {

/// Limits of time and memory for one run. With sanitizers a run needs several times more of both.
struct Limits {
  double cancel_after = 2.0;  ///< seconds of processor time after which the run is cancelled
  double obey_within = 1.0;   ///< seconds in which it must end after that
  long kilobytes = 500000;    ///< memory; 0: unlimited
};

/// The limits for this build, with or without sanitizers.
Limits default_limits();

/// The function to run in a separate process. It returns a sentence about a fault of the outcome;
/// empty if there is none. `cancel` is set when the time is up.
using Body = std::function<std::string(const std::atomic<bool>& cancel)>;

/// Runs `body` in a separate process and returns a sentence about a fault, empty if there is none:
/// the result of the body, a crash, a sanitizer's report, too much time or memory. @param disk
/// limit of the size of any file that is written [bytes].
std::string run_isolated(const Body& body, const Limits& limits,
                         std::optional<long> disk = std::nullopt);

}  // namespace codesign::fuzz
