// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

namespace codesign {

/// Processor time [s] since construction.
class CpuTimer {
 public:
  enum class Of {
    kThread,  ///< of the constructing thread; seconds() must be called in the same thread
    kProcess  ///< of all threads, for work that several of them share
  };
  explicit CpuTimer(Of of = Of::kThread)
      : clock_(of == Of::kThread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID) {}

  double seconds() const { return now() - start_; }

 private:
  double now() const {
    timespec t{};
    clock_gettime(clock_, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  clockid_t clock_;
  double start_ = now();
};

}  // namespace codesign
