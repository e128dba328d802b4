// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace codesign {

/// Wakes the thread that waits for commands and requests. Thread-safe.
class Bell {
 public:
  void ring() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++rung_;
    }
    condition_.notify_all();
  }

  /// Returns once the bell has been rung since the last wait(), or after `seconds`. For one waiting thread.
  void wait(double seconds) {
    std::unique_lock<std::mutex> lock(mutex_);
    condition_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return rung_ != heard_; });
    heard_ = rung_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  std::uint64_t rung_ = 0, heard_ = 0;
};

}  // namespace codesign
