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
  /// Cancels the running job and waits for its end.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Hands over a job, or returns false at once if another one is still running. A job must not throw.
  bool try_start(Job job);

  /// Sets the flag of the running job, if any.
  void cancel() { cancel_ = true; }

  bool busy() const;

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Job job_;            // empty: idle
  bool ending_ = false;
  std::atomic<bool> cancel_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_ROS_WORKER_H_
