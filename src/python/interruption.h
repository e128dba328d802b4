// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "python/python_lock.h"

namespace codesign::python {

/// Ends a computation early, which runs without Python's lock: while an object of this class exists
/// in Python's main thread, SIGINT sets the flag that the computation obeys, before Python's own
/// handler runs. In other threads, to which Python gives no KeyboardInterrupt, only stop() and
/// fail() set it. Each call has a flag of its own, also where a callback starts another one.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The flag for the `cancel` arguments of the library.
  const std::atomic<bool>* flag() const { return flag_; }
  void stop() { *flag_ = true; }
  /// Stops the computation, behind which check() raises the first of these errors. Thread-safe.
  void fail(pybind11::error_already_set&& error);
  /// Behind the computation, with Python's lock: runs the signal handlers that wait. @throws
  /// pybind11::error_already_set for fail(), and if a handler raises an exception, as Python's own
  /// handler of SIGINT does.
  void check();

 private:
  std::atomic<bool> own_{false};
  std::atomic<bool>* flag_;
  std::mutex mutex_;  ///< guards error_
  std::optional<pybind11::error_already_set> error_;
};

/// Asks an event of Python's `threading` every 50 ms whether it is set, and then stops the
/// computation. An exception of the event ends the computation, too, and is raised behind it. Made
/// and destroyed without Python's lock.
class EventWatch {
 public:
  /// @param event has `is_set()`; None: there is none. Must outlive this, as `interruption` must.
  EventWatch(pybind11::handle event, Interruption* interruption);
  ~EventWatch();
  EventWatch(const EventWatch&) = delete;
  EventWatch& operator=(const EventWatch&) = delete;

 private:
  void watch(pybind11::handle event, Interruption* interruption);

  std::mutex mutex_;
  std::condition_variable ends_;
  bool is_over_ = false;
  std::thread thread_;
};

/// work(cancel) without Python's lock. @throws pybind11::error_already_set for Ctrl-C, as
/// Interruption::check().
template <class Work>
auto interruptible(const Work& work) {
  Interruption interruption;
  auto result = [&] {
    const Unlocked unlocked;
    return work(interruption.flag());
  }();
  interruption.check();
  return result;
}

}  // namespace codesign::python
