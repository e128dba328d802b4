// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "description/linear_measure.h"
#include "linear/flowing_period.h"
#include "linear/loop_margins.h"
#include "linear/pole_margins.h"
#include "linear/state_space.h"

namespace codesign {

/// The loop of a continuous controller beside sampled ones, theory (69b): it flows between the
/// instants of a period, at which the others act.
class FlowingLoop : public FactoredLoop {
 public:
  /// @param closed with pieces, from an effort added to the controller's output to that output.
  explicit FlowingLoop(ComplexSpace closed);

  /// The part of the response to a sinusoid that has its frequency [rad/s]; of a loop that sampled
  /// controllers do not touch its L.
  std::complex<double> at(double frequency) const;
  /// Frequencies at which it is to be seen, ascending.
  const std::vector<double>& grid() const { return grid_; }
  /// Gain, phase and delay margins by find_pole_margins(). Ms and Mt are the largest norms of what
  /// becomes of any added signal; there are none where a sampled controller reads what the signal
  /// moves at once, which is infinite.
  LoopMargins margins() const;
  /// The derivative of one of them. @param rest LoopMargins::rest.
  double derivative_of(const AtFrequency& margin, LinearMeasure::Kind kind, double rest) const;

  Eigen::MatrixXcd closed_by(std::complex<double> factor) const override;
  Eigen::MatrixXcd by_factor(std::complex<double> factor) const override;
  double frequency_of(std::complex<double> factor, const EigenTriple& pole) const override;
  AtFrequency at_infinity() const override { return {-open_.D.real(), grid_.back()}; }

 private:
  /// The part of the closed loop's output at a frequency.
  using Part = std::function<std::complex<double>(double frequency)>;
  std::vector<AtFrequency> peaks_of(bool complementary, const Part& part) const;
  double norm_derivative(const AtFrequency& margin, bool complementary) const;
  double bandwidth_derivative(double frequency, double rest) const;
  void find_peaks(LoopMargins* margins) const;

  const ComplexSpace space_;
  const FlowingSpace closed_, open_;
  const double period_;
  bool is_stable_ = true;
  std::vector<double> grid_;
};

}  // namespace codesign
