// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace codesign {

/// The longest wait of a test for anything; test/patience.py has that of Python. Of what takes a
/// second on an idle machine, one that is a hundred times slower has it within this time. It is
/// less than a test may take as a whole.
constexpr std::chrono::seconds kPatience{120};

/// Waits for a condition, at most kPatience.
inline bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace codesign
