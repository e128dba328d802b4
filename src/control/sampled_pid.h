// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "control/anti_windup.h"
#include "description/control_realization.h"

namespace codesign {

/// The memory of a sampled PID between two samples, theory (51).
template <class T>
struct SampledPidMemory {
  T integral{0.0};    ///< sum of T e [unit of e, s]
  T last_error{0.0};  ///< what the derivative acts on, at the last sample [unit of e]
  T error_rate{0.0};  ///< its filtered rate [unit of e, 1/s]
};

/// The numbers of a sampled PID.
template <class T>
struct SampledPidNumbers {
  Pid<T> gains;
  double sample_time = 0.0;  ///< [s]
  T derivative_filter{0.0};  ///< time constant [s]; 0: none
  const Bounds<T>* i_clamp = nullptr;
  AntiWindup antiwindup = AntiWindup::kNone;
  const Bounds<T>* limit = nullptr;  ///< of the output; for the methods that need it
  T tracking{0.0};                   ///< T_t i of back-calculation [unit of the output per e]
};

/// What anti-windup makes of the integral after a sample, theory (51a).
/// @param v the output before its limit; conditional integration reduces it with the integral.
template <class T>
void unwind(const SampledPidNumbers<T>& numbers, const T& error, SampledPidMemory<T>* memory,
            T* v) {
  const T period(numbers.sample_time);
  if (numbers.antiwindup == AntiWindup::kBackCalculation)
    memory->integral -= period * tracked(T(*v - clamp(*v, *numbers.limit)), numbers.tracking);
  if (numbers.antiwindup != AntiWindup::kConditional) return;
  const T step = numbers.gains.i * period * error, beyond = *v - clamp(*v, *numbers.limit);
  if (!is_less(T(0.0), T(step * beyond), false)) return;
  const T excess = is_less(T(beyond * beyond), T(step * step), false) ? beyond : step;
  memory->integral -= excess / numbers.gains.i;
  *v -= excess;
}

/// One sample of a PID, theory (51), in the order of control_toolbox's Pid::computeCommand():
/// updates the memory and returns the output before its limit. At the first sample there is no
/// rate.
/// @param rated what the derivative acts on: the error, or minus the measured input.
template <class T>
T sample_pid(const SampledPidNumbers<T>& numbers, const T& error, const T& rated, bool is_first,
             SampledPidMemory<T>* memory) {
  const T period(numbers.sample_time);
  memory->integral += period * error;
  T integral_term = numbers.gains.i * memory->integral;
  if (numbers.i_clamp && numbers.antiwindup == AntiWindup::kClamping) {
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
    memory->error_rate = (tau * memory->error_rate + rated - memory->last_error) / (tau + period);
  }
  memory->last_error = rated;
  T output = numbers.gains.p * error + integral_term + numbers.gains.d * memory->error_rate;
  unwind(numbers, error, memory, &output);
  return output;
}

}  // namespace codesign
