// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "python/interruption.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <utility>

namespace codesign::python {
namespace {

namespace py = pybind11;

/// Flags of the calls in Python's main thread, which may be nested: a callback may start another
/// one. They outlive the calls, since the signal may come in any thread. Calls that are nested
/// deeper share the last one.
std::array<std::atomic<bool>, 64> interrupted;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not take a lock");
std::size_t depth = 0;
struct sigaction before;

extern "C" void on_interrupt(int number, siginfo_t* info, void* context) {
  for (std::atomic<bool>& flag : interrupted) flag = true;
  if ((before.sa_flags & SA_SIGINFO) != 0)
    before.sa_sigaction(number, info, context);
  else
    before.sa_handler(number);
}

bool is_ours(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 && action.sa_sigaction == on_interrupt;
}

/// A program that embeds Python may leave SIGINT to the system, or ignore it.
bool has_handler(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) != 0 ||
         (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

bool is_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("main_thread")().attr("ident").cast<std::uint64_t>() ==
         PyThread_get_thread_ident();
}

}  // namespace

Interruption::Interruption() : flag_(&own_) {
  if (!is_main_thread()) return;
  const std::size_t place = depth++;
  flag_ = &interrupted[std::min(place, interrupted.size() - 1)];
  if (place < interrupted.size()) *flag_ = false;
  if (place > 0) return;
  sigaction(SIGINT, nullptr, &before);
  if (!has_handler(before)) return;
  struct sigaction ours = before;
  ours.sa_flags |= SA_SIGINFO;
  ours.sa_sigaction = on_interrupt;
  sigaction(SIGINT, &ours, nullptr);
}

Interruption::~Interruption() {
  if (flag_ == &own_ || --depth > 0) return;
  struct sigaction now;
  sigaction(SIGINT, nullptr, &now);
  // A callback may have set another handler.
  if (is_ours(now)) sigaction(SIGINT, &before, nullptr);
}

void Interruption::fail(py::error_already_set&& error) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!error_) error_.emplace(std::move(error));
  stop();
}

void Interruption::check() {
  if (error_) {
    py::error_already_set error = std::move(*error_);
    error_.reset();
    throw error;
  }
  if (flag_ != &own_ && *flag_ && PyErr_CheckSignals() != 0) throw py::error_already_set();
}

EventWatch::EventWatch(py::handle event, Interruption* interruption) {
  if (!event.is_none())
    thread_ = std::thread([this, event, interruption] { watch(event, interruption); });
}

EventWatch::~EventWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  ends_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void EventWatch::watch(py::handle event, Interruption* interruption) {
  constexpr std::chrono::milliseconds kPeriod(50);
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_over_) {
    lock.unlock();
    {
      const Locked locked;
      try {
        const int is_set =
            outlive_python([&] { return PyObject_IsTrue(event.attr("is_set")().ptr()); });
        if (is_set < 0) throw py::error_already_set();
        if (is_set > 0) interruption->stop();
      } catch (py::error_already_set& error) {
        interruption->fail(std::move(error));
      }
    }
    lock.lock();
    ends_.wait_for(lock, kPeriod, [this] { return is_over_; });
  }
}

}  // namespace codesign::python
