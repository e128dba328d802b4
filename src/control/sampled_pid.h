// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "forces/control_law.h"
#include "math/scalar.h"

namespace codesign {

/// x within -bound to bound, as a program on a robot clamps it. Piecewise differentiable: at the
/// bound itself the derivative has the value inside.
/// @param bound not negative, in the unit of x.
template <class T>
T clamp(const T& x, const T& bound) {
  if (is_less(bound, x, false)) return bound;
  if (is_less(x, T(-bound), false)) return -bound;
  return x;
}

/// Anti-windup of a continuous integral, theory (50): with y = |i| s / bound and d = bound / (100 s
/// |i|),
///   s' = e - y^8 (e + sgn(y) (e^2 + d^2)^(1/2)) / 2,
/// which is e if s moves towards zero, and e (1 - y^8) if it moves towards the bound, except for
/// errors as small as d. The integral term i s stays within -bound to bound and leaves the bound at
/// once when e changes its sign. Smooth: a kink at e = 0 would be a jump in the sensitivities'
/// rates.
/// @param bound positive [unit of the output].
template <class T>
T clamped_integral_rate(const T& e, const T& s, const T& i, const T& bound) {
  using std::sqrt;
  constexpr double kRate = 0.01;   // [1/s]: d would take 100 s from zero to the bound
  constexpr double kTiny = 1e-30;  // keeps the root at y = 0 differentiable
  const T gain = is_less(i, T(0.0), false) ? T(-i) : i;
  if (!is_less(T(0.0), gain, true)) return e;
  const T per_bound = gain / bound, y = per_bound * s, d = T(kRate) / per_bound;
  const T y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y8 = y4 * y4;
  const T size = sqrt(y2 + T(kTiny)), outward = sqrt(e * e + d * d);
  return e - T(0.5) * (y8 * e + y6 * y * size * outward);
}

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
  const T* i_clamp = nullptr;
  bool antiwindup = false;
};

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
    memory->error_rate = (tau * memory->error_rate + rated - memory->last_error) / (tau + period);
  }
  memory->last_error = rated;
  return numbers.gains.p * error + integral_term + numbers.gains.d * memory->error_rate;
}

}  // namespace codesign
