// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace codesign {

/// Samples as a continuous function of time: cubic between them, with the slopes of the parabolas
/// through three neighbours, so that its first derivative is continuous. Before the first sample
/// and after the last it is held.
class SampledFunction {
 public:
  /// @param times ascending [s]. @param values one per time, finite; at least one.
  /// @throws std::invalid_argument for other sizes or orders.
  SampledFunction(std::vector<double> times, std::vector<double> values);

  /// Value and time derivatives at a time [s]; at a sample the second and third derivatives of the
  /// following piece hold.
  struct Sample {
    double value = 0.0, slope = 0.0, second = 0.0, third = 0.0;
  };
  Sample at(double time) const;
  /// Whether the samples reach from before a time to after it.
  bool covers(double time) const { return times_.front() <= time && time <= times_.back(); }
  const std::vector<double>& times() const { return times_; }

 private:
  std::vector<double> times_, values_, slopes_;
};

}  // namespace codesign
