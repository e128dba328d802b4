// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "math/scalar.h"

namespace codesign {

/// Smooth absolute value cabs(x) = sqrt(x^2 + epsilon^2), as in the paper.
template <class T>
T smooth_abs(const T& x, const T& epsilon) {
  using std::sqrt;
  return sqrt(x * x + epsilon * epsilon);
}

/// atan2(y, x) [rad], in (-pi, pi]. For complex numbers and lanes the derivative is exact to first order.
inline double arc_tangent(double y, double x) { return std::atan2(y, x); }
inline std::complex<double> arc_tangent(const std::complex<double>& y, const std::complex<double>& x) {
  const double square = x.real() * x.real() + y.real() * y.real();
  return {std::atan2(y.real(), x.real()), (x.real() * y.imag() - y.real() * x.imag()) / square};
}
template <int N>
Lanes<N> arc_tangent(const Lanes<N>& y, const Lanes<N>& x) {
  return atan2(y, x);
}

/// The nearest integer, without derivative. Ties round to an even number, as in compiled code (Operation::kRound).
template <class T>
T nearest_integer(const T& x) {
  return T(std::nearbyint(value_of(x)));
}

/// The whole turns, a multiple of 2 pi [rad], that bring `angle` nearest to `reference` when added to it. They have no derivative. Ties
/// round to an even number of turns.
template <class T>
T nearest_turns(double reference, const T& angle) {
  return T(2.0 * M_PI) * nearest_integer(T((T(reference) - angle) / T(2.0 * M_PI)));
}

}  // namespace codesign
