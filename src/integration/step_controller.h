// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

namespace codesign {

/// Step-size control with Gustafsson's prediction, as in the code RODAS of Hairer and Wanner [5].
class StepController {
 public:
  /// @param order the order of the method.
  explicit StepController(int order) : exponent_(1.0 / order) {}

  /// Whether a step of size h [s] with this scaled error is accepted, error <= 1; `proposal` receives the size of the next attempt [s].
  bool accept(double h, double error, double* proposal) {
    double factor = limit(std::pow(error, exponent_) / kSafety);
    if (!(error <= 1.0)) {
      *proposal = h / (std::isfinite(error) ? std::max(factor, 1.1) : kLargestReduction);
      rejected_ = true;
      return false;
    }
    if (accepted_error_ > 0.0)
      factor = std::max(factor, limit(accepted_h_ / h * std::pow(error * error / accepted_error_, exponent_) / kSafety));
    if (rejected_) factor = std::max(factor, 1.0);
    accepted_h_ = h;
    accepted_error_ = std::max(1e-2, error);
    rejected_ = false;
    *proposal = h / factor;
    return true;
  }

  /// The next size [s] after an attempt of size h that could not be computed.
  double back_off(double h) {
    rejected_ = true;
    return h / kLargestReduction;
  }

 private:
  static constexpr double kSafety = 0.9, kLargestReduction = 5.0, kLargestGrowth = 6.0;
  static double limit(double factor) { return std::max(1.0 / kLargestGrowth, std::min(kLargestReduction, factor)); }

  double exponent_;
  double accepted_h_ = 0.0, accepted_error_ = 0.0;
  bool rejected_ = false;
};

}  // namespace codesign
