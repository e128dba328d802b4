// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/clamp.h"
#include "forces/pid.h"

namespace codesign {

/// The memory of a sampled PID between two samples, theory (51).
template <class T>
struct SampledPidMemory {
  T integral{0.0};    ///< sum of T e [unit of e, s]
  T last_error{0.0};  ///< e at the last sample
  T error_rate{0.0};  ///< the filtered rate of e [unit of e, 1/s]
};

/// The numbers of a sampled PID.
template <class T>
struct SampledPidNumbers {
  Pid<T> gains;
  double sample_time = 0.0;  ///< [s]
  T derivative_filter{0.0};  ///< time constant [s]; 0: none
  const T* i_clamp = nullptr;
  bool antiwindup = false;
};

/// One sample of a PID, theory (51), in the order of control_toolbox's Pid::computeCommand(): updates the memory and returns the output
/// before its limit. At the first sample the error has no rate.
template <class T>
T sample_pid(const SampledPidNumbers<T>& numbers, const T& error, bool is_first, SampledPidMemory<T>* memory) {
  const T period(numbers.sample_time);
  memory->integral += period * error;
  T integral_term = numbers.gains.i * memory->integral;
  if (numbers.i_clamp && numbers.antiwindup) {
    const T kept = clamp(integral_term, *numbers.i_clamp);
    // If nothing is cut off, or the gain is zero, the integral stays unchanged to the last bit.
    if (is_less(kept, integral_term, false) || is_less(integral_term, kept, false)) {
      integral_term = kept;
      memory->integral = kept / numbers.gains.i;
    }
  } else if (numbers.i_clamp) {
    integral_term = clamp(integral_term, *numbers.i_clamp);
  }
  if (!is_first) {
    const T& tau = numbers.derivative_filter;
    memory->error_rate = (tau * memory->error_rate + error - memory->last_error) / (tau + period);
  }
  memory->last_error = error;
  return numbers.gains.p * error + integral_term + numbers.gains.d * memory->error_rate;
}

}  // namespace codesign
