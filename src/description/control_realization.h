// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "description/expression.h"

namespace codesign {

/// How a robot runs a controller, theory (50)-(54): bounds, sampling and the lag of the drive.
/// Absent numbers have no effect.
struct ControlRealization {
  /// kPid: largest magnitude of the integral term [unit of the output]
  std::optional<Quantity> i_clamp;
  bool antiwindup = false;  ///< kPid: the integral itself stays within i_clamp, not its term alone
  /// kPid: time constant of the low-pass filter on the error's rate [s]
  std::optional<Quantity> derivative_filter;
  /// kPid: d acts on the rate of minus the input, not on that of the error
  bool rates_input = false;
  std::optional<Quantity> output_limit;   ///< largest magnitude of the output [unit of the output]
  std::optional<Quantity> time_constant;  ///< of the drive, from the output to the effort [s]
  double sample_time = 0.0;               ///< [s]; 0: the controller is continuous
  /// from a sample to the output that follows from it [s]; sampled controllers only
  double delay = 0.0;
  /// resolution of the measured input, in its unit; 0: none; sampled kPid only
  double quantization = 0.0;

  bool is_sampled() const { return sample_time > 0.0; }
  /// Number of outputs that wait at most: computed, but not yet in effect.
  int queued() const;
};

}  // namespace codesign
