// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace codesign::python {

/// Ends a computation early, which runs without Python's lock: while an object of this class exists
/// in Python's main thread, SIGINT sets the flag that the computation obeys, before Python's own
/// handler runs. In other threads, to which Python gives no KeyboardInterrupt, the flag is one that
/// only stop() sets.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The flag for the `cancel` arguments of the library.
  const std::atomic<bool>* flag() const { return flag_; }
  void stop() { *flag_ = true; }
  /// Runs the signal handlers that wait. @throws pybind11::error_already_set if one of them raises
  /// an exception, as Python's own handler of SIGINT does.
  void check() const;

 private:
  std::atomic<bool> own_{false};
  std::atomic<bool>* flag_;
};

/// Asks an event of Python's `threading` every 50 ms whether it is set, and then stops the
/// computation. Made and destroyed without Python's lock.
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
  const Interruption interruption;
  auto result = [&] {
    const pybind11::gil_scoped_release release;
    return work(interruption.flag());
  }();
  interruption.check();
  return result;
}

}  // namespace codesign::python
