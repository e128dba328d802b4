// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_ROS_WORKER_H_
#define MECHANISM_CODESIGN_ROS_WORKER_H_

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace codesign {

/// One thread that does one job at a time, so that no callback ever computes.
class Worker {
 public:
  /// A job ends soon once the flag it is given is set.
  using Job = std::function<void(const std::atomic<bool>& cancel)>;

  Worker();
  ~Worker() { finish(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Hands over a job, or returns false at once if another one is still running. Neither function may throw.
  /// @param done called in the worker's thread when it is free for the next job, so that whoever is told may come back at once.
  bool try_start(Job job, std::function<void()> done);

  /// Sets the flag of the running job, if any.
  void cancel() { cancel_ = true; }

  /// Cancels the running job, waits for its end, and takes no further ones.
  void finish();

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

#endif  // MECHANISM_CODESIGN_ROS_WORKER_H_
