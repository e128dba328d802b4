// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MATH_CPU_TIMER_H_
#define MECHANISM_CODESIGN_MATH_CPU_TIMER_H_

#include <ctime>

namespace codesign {

/// Processor time [s] of the constructing thread since construction; seconds() must be called in the same thread.
class CpuTimer {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

}  // namespace codesign

#endif  // MECHANISM_CODESIGN_MATH_CPU_TIMER_H_
