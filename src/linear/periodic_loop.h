// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "linear/loop_margins.h"
#include "linear/pole_margins.h"
#include "linear/state_space.h"

namespace codesign {

/// A loop opened at the samples of one controller in a period, u to y, theory (69a):
/// x(k+1) = A x(k) + B u(k), y(k) = C x(k) + D u(k), D strictly lower triangular.
struct OpenedPeriod : FactoredLoop {
  Eigen::MatrixXd A, B, C, D;
  double period = 0.0;  ///< [s]

  /// @param closed sampled_loop()
  explicit OpenedPeriod(const StateSpace& closed);
  OpenedPeriod(const Eigen::MatrixXd& closed_A, const Eigen::MatrixXd& closed_B,
               const Eigen::MatrixXd& closed_C, const Eigen::MatrixXd& closed_D, double time);

  Eigen::MatrixXcd closed_by(std::complex<double> factor) const override;
  /// y of x where u = factor y.
  Eigen::MatrixXcd outputs(std::complex<double> factor) const;
  Eigen::MatrixXcd by_factor(std::complex<double> factor) const override;
  double frequency_of(std::complex<double> factor, const EigenTriple& pole) const override;
};

/// Numbers at samples, of which period after period is `turn` times the one before, seen as one
/// sinusoid: the frequency [rad/s] of the largest of the sinusoids that they are made of, which are
/// a turn per period apart; negative if it turns backwards.
/// @param angle of the turn [rad].
double main_frequency(const Eigen::VectorXcd& samples, double angle, double period);
/// exp(j w t) at the samples of a period.
Eigen::VectorXcd sinusoid(double frequency, Eigen::Index samples, double period);

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
