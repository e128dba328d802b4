// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>

#include "description/linear_measure.h"
#include "linear/loop_margins.h"
#include "math/linear_systems.h"

namespace codesign {

/// A loop over a period whose output is multiplied by a factor before it closes the loop again: 1
/// is the loop as it is.
class FactoredLoop {
 public:
  FactoredLoop() = default;
  FactoredLoop(const FactoredLoop&) = default;
  FactoredLoop& operator=(const FactoredLoop&) = default;
  FactoredLoop(FactoredLoop&&) = default;
  FactoredLoop& operator=(FactoredLoop&&) = default;
  virtual ~FactoredLoop() = default;

  /// The map of the states over a period, and its derivative by the factor.
  virtual Eigen::MatrixXcd closed_by(std::complex<double> factor) const = 0;
  virtual Eigen::MatrixXcd by_factor(std::complex<double> factor) const = 0;
  /// The frequency [rad/s] of the largest of the sinusoids, a turn per period apart, that are the
  /// output in a motion of closed_by(factor); negative if it turns backwards.
  virtual double frequency_of(std::complex<double> factor, const EigenTriple& pole) const = 0;
  /// L of infinitely fast signals, and the frequency [rad/s] that stands for theirs; 0: none reach
  /// the output at once.
  virtual AtFrequency at_infinity() const { return {}; }
};

/// Sets gain, phase and delay margins by poles, theory (69a): factors gain or exp(-j phase) at
/// which an eigenvalue of the map over a period has the size 1; a delay margin is the phase up to
/// it by its frequency. Where L of infinitely fast signals is between -1 and 0 a pole passes
/// through infinity at the gain that makes it -1; where it exceeds 1 any delay makes the loop
/// unstable.
/// @param margins with `is_stable`: of an unstable loop there is only a reduction, if one helps.
void find_pole_margins(const FactoredLoop& loop, LoopMargins* margins);

/// The derivative of one of them along a direction of the design: the eigenvalue stays on the
/// circle. @param moved_by the derivative of closed_by(factor) along the direction.
using MovedBy = std::function<Eigen::MatrixXcd(std::complex<double> factor)>;
double pole_margin_derivative(const FactoredLoop& loop, const MovedBy& moved_by, double period,
                              const AtFrequency& margin, LinearMeasure::Kind kind);

}  // namespace codesign
