// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "linear/loop_margins.h"
#include "linear/opened_period.h"
#include "linear/pole_margins.h"
#include "linear/state_space.h"

namespace codesign {

/// The loop of a controller that samples several times in the common period of all, theory (69a):
/// no transfer function, but a map from its outputs in a period to those that it computes then.
class PeriodicLoop {
 public:
  /// @param closed sampled_loop().
  explicit PeriodicLoop(const StateSpace& closed);

  /// The part of the response to a sinusoid that has its frequency [rad/s]; of a loop that does not
  /// change from sample to sample its L.
  std::complex<double> at(double frequency) const;
  /// Frequencies at which it is to be seen.
  const std::vector<double>& grid() const { return grid_; }
  /// Gain, phase and delay margins by find_pole_margins(), the factor of all outputs. Sensitivities
  /// are the largest norms from outputs that are added to those that result.
  LoopMargins margins() const;

 private:
  std::complex<double> closed_at(double frequency) const;
  double norm_at(double frequency, bool complementary, Eigen::VectorXcd* right) const;
  std::vector<AtFrequency> peaks_of(bool complementary) const;
  void find_peaks(LoopMargins* margins) const;

  StateSpace closed_;
  OpenedPeriod open_;
  Eigen::Index samples_;
  double period_;
  bool is_stable_;
  std::vector<double> grid_, of_period_;
};

}  // namespace codesign
