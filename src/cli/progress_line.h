// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace codesign::cli {

/// Bounds the number of lines that a long job prints: the first kLines all, later ones only after a
/// hundredth of the time so far, so that the next e times that time have some hundred lines.
class LinePace {
 public:
  static constexpr int kLines = 200;

  /// Whether a line is printed at `seconds` since the job began, which ascend.
  bool admits(double seconds);
  /// The same now, counted from the construction of this object.
  bool admits_now() {
    return admits(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count());
  }

 private:
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  int lines_ = 0;
  double last_ = 0.0;
};

}  // namespace codesign::cli
