// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <vector>

#include "description/expression.h"
#include "forces/filter_law.h"
#include "mechanism_codesign/error.h"

namespace codesign {

/// `[lower, upper]`, or one number for both sides.
struct ControlBounds {
  Quantity upper;
  std::optional<Quantity> lower;  ///< absent: -upper
};

/// What keeps an integral from growing without use, theory (50), (50a), (50b).
enum class AntiWindup {
  kNone,             ///< nothing; i_clamp bounds the integral term alone
  kClamping,         ///< the integral itself stays within i_clamp
  kBackCalculation,  ///< what output_limit cuts off draws the integral back
  kConditional       ///< the integral stops where it leads beyond output_limit
};

/// A filter of a signal on its way into a controller, theory (49).
struct FilterDescription {
  FilterKind kind = FilterKind::kLowPass;
  std::vector<Quantity> numbers;  ///< in the order of kind->numbers
  SourceLocation where;
};

/// How a robot runs a controller, theory (50)-(54): bounds, sampling and the lag of the drive.
/// Absent numbers have no effect.
struct ControlRealization {
  std::optional<ControlBounds> i_clamp;       ///< kPid: of the integral term [unit of the output]
  AntiWindup antiwindup = AntiWindup::kNone;  ///< kPid
  /// kPid, kBackCalculation: [s]; by default p / i
  std::optional<Quantity> tracking_time;
  /// kPid: time constant of the low-pass filter on the error's rate [s]
  std::optional<Quantity> derivative_filter;
  /// kPid: d acts on the rate of minus the input, not on that of the error
  bool rates_input = false;
  std::optional<ControlBounds> output_limit;  ///< [unit of the output]
  /// output_limit has corners, as in samples, also where the controller is continuous, theory (50)
  bool limit_has_corners = false;
  /// of the output [its unit per s], > 0 upwards: from sample to sample, or of a continuous
  /// controller of the effort after the lag of the drive
  std::optional<ControlBounds> rate_limit;
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
