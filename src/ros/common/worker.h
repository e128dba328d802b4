// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace codesign {

/// A thread that runs one job at a time, so that callbacks do not compute.
class Worker {
 public:
  /// A job must end soon after the flag is set, and must not throw.
  using Job = std::function<void(const std::atomic<bool>& cancel)>;

  Worker();
  ~Worker() { finish(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts a job and returns true, or returns false at once if another job is running.
  /// @param done called in the worker's thread when it is free for the next job, so that a client
  /// notified by it can start one at once. Must not throw.
  bool try_start(Job job, std::function<void()> done);

  /// Sets the flag of the running job, if any. @returns whether a job runs that had not been
  /// cancelled before.
  bool cancel();

  /// Cancels the running job, waits for its end, and accepts no further jobs.
  void finish();

  /// Whether a job is running.
  bool busy() const;

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Job job_;  // empty: idle
  std::function<void()> done_;
  bool ending_ = false;
  std::atomic<bool> cancel_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace codesign
