// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace codesign {

/// A Butterworth low-pass filter that runs over samples forward and then backward, so that it does
/// not delay; doc/theory.md (29). Linear in the samples; constants and straight lines pass
/// unchanged away from the ends. The gain at the cutoff is 1/2 (-6 dB).
///
/// Both ends are continued by 3 (order + 1) samples, mirrored in the end point, and each run begins
/// in the steady state of its first sample, as in scipy.signal.filtfilt and MATLAB's filtfilt, with
/// the same results. Second-order sections keep the precision at low cutoffs.
class ZeroPhaseFilter {
 public:
  /// @param order of the Butterworth filter, at least 1. @param cutoff [Hz], between 0 and rate
  /// / 2. @param rate samples per second [Hz]
  ZeroPhaseFilter(int order, double cutoff, double rate);

  /// Fewer samples than this cannot be filtered: 3 (order + 1) + 1.
  Eigen::Index least_samples() const { return padding_ + 1; }

  /// Memory of apply().
  using Workspace = std::vector<double>;
  /// Filters `samples` in place; at least least_samples() of them.
  void apply(Eigen::Ref<Eigen::VectorXd> samples, Workspace* workspace) const;
  /// Filters each column in place.
  void apply_to_columns(Eigen::Ref<Eigen::MatrixXd> columns, Workspace* workspace) const;

 private:
  /// y = (b0 + b1 z^-1 + b2 z^-2) / (1 + a1 z^-1 + a2 z^-2) x, of gain 1 at frequency 0.
  struct Section {
    double b0, b1, b2, a1, a2;
  };
  static void run(const Section& section, double* first, double* last, std::ptrdiff_t step);

  std::vector<Section> sections_;
  Eigen::Index padding_;
};

}  // namespace codesign
