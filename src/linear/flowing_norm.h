// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "linear/state_space.h"

namespace codesign {

/// The amplification of signals by a loop that flows between the instants of a period, from w to
/// z = y + shift w, theory (69b): `level` is a singular value for signals that turn by an angle
/// [rad] per period where a pencil of the Hamiltonian motion of states and costates is singular at
/// exp(j angle) (Bamieh and Pearson 1992).
class FlowingNorm {
 public:
  /// @param space without effect of w on jumps, which no norm bounds.
  FlowingNorm(ComplexSpace space, double shift);

  /// A largest value at its angle.
  struct Peak {
    double value, angle;
  };
  /// The largest amplification; none: it does not exceed the known one; infinite: no bound is
  /// found.
  /// @param known at least the direct part of the loop.
  std::optional<Peak> above(const Peak& known) const;
  /// The derivative of an amplification along the direction of the space, at a fixed angle.
  double derivative_of(const Peak& peak) const;
  /// |shift + D|, the amplification of signals that are infinitely fast, and its derivative.
  double of_fast_signals() const;
  double derivative_of_fast_signals() const;

 private:
  /// Singular at z: M - z N. Imaginary parts are derivatives.
  struct Pencil {
    Eigen::MatrixXcd M, N;
    bool is_below = true;  ///< whether no signal of some periods, from rest, exceeds the level
  };
  struct Turning;

  Pencil pencil(const ComplexSpace& space, std::complex<double> level, bool with_doublings) const;
  std::optional<double> angle_at(double level, double otherwise) const;
  Turning turning(const Peak& peak) const;
  bool refine(Peak* peak) const;

  const ComplexSpace space_, values_;
  const double shift_;
  std::vector<std::complex<double>> marginal_;  ///< motions on the unit circle by themselves
};

}  // namespace codesign
