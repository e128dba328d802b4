// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>

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
/// The amplitude of a sinusoid e of n samples in the values at them: e^H values / n.
std::complex<double> part_at(const Eigen::VectorXcd& sinusoid, const Eigen::VectorXcd& values);

}  // namespace codesign
