// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>

#include "math/lanes.h"

namespace codesign {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Vector4 = Eigen::Matrix<T, 4, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;
template <class T>
using Matrix4 = Eigen::Matrix<T, 4, 4>;
template <class T>
using Matrix34 = Eigen::Matrix<T, 3, 4>;
template <class T>
using VectorX = Eigen::Matrix<T, Eigen::Dynamic, 1>;

/// The value without derivatives or imaginary part. Branches use it, since they must not depend on
/// the derivatives.
inline double value_of(double x) { return x; }
inline double value_of(const std::complex<double>& x) { return x.real(); }
template <int N>
double value_of(const Lanes<N>& x) {
  return x.a;
}

/// The place of a decision in the source, for decisions that recordings turn round together.
constexpr unsigned place_in_source(const char* file, unsigned line) {
  unsigned hash = line;
  for (; *file; ++file) hash = 31 * hash + static_cast<unsigned char>(*file);
  return hash;
}

/// Whether value_of(x) < value_of(y). Formulas branch by this function only, so that they can be
/// recorded for compilation (codegen/traced.h).
/// @param likely the outcome that the first recording follows where it depends on the state; other
/// outcomes are recorded when they occur.
template <class T>
bool is_less(const T& x, const T& y, bool likely,
             unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
  static_cast<void>(likely), static_cast<void>(place);
  return value_of(x) < value_of(y);
}

// The derivatives that a vector of complex numbers (imaginary parts) or of lanes carries, as a real
// matrix: one row per component, one column per direction. The derivatives of a solution of
// equations follow from a linear solve with this matrix on the right-hand side (implicit function
// theorem).

/// The derivatives of x: x.size() x 1 for complex numbers, x.size() x N for lanes. @param d resized
/// and filled.
inline void directions_of(const VectorX<std::complex<double>>& x, Eigen::MatrixXd* d) {
  *d = x.imag();
}
template <int N>
void directions_of(const VectorX<Lanes<N>>& x, Eigen::MatrixXd* d) {
  d->resize(x.size(), N);
  for (Eigen::Index k = 0; k < x.size(); ++k) d->row(k) = x[k].directions().transpose();
}
template <class T>
Eigen::MatrixXd directions_of(const VectorX<T>& x) {
  Eigen::MatrixXd d;
  directions_of(x, &d);
  return d;
}

/// Adds d, of the shape of directions_of(*x), to the derivatives of x.
inline void add_directions(const Eigen::MatrixXd& d, VectorX<std::complex<double>>* x) {
  for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k] += std::complex<double>(0.0, d(k, 0));
}
template <int N>
void add_directions(const Eigen::MatrixXd& d, VectorX<Lanes<N>>* x) {
  for (Eigen::Index k = 0; k < x->size(); ++k) (*x)[k].directions() += d.row(k).transpose();
}

/// Smooth absolute value cabs(x) = sqrt(x^2 + epsilon^2), as in the paper.
template <class T>
T smooth_abs(const T& x, const T& epsilon) {
  using std::sqrt;
  return sqrt(x * x + epsilon * epsilon);
}

/// atan2(y, x) [rad], in (-pi, pi]. For complex numbers and lanes the derivative is exact to first
/// order.
inline double arc_tangent(double y, double x) { return std::atan2(y, x); }
inline std::complex<double> arc_tangent(const std::complex<double>& y,
                                        const std::complex<double>& x) {
  const double square = x.real() * x.real() + y.real() * y.real();
  return {std::atan2(y.real(), x.real()), (x.real() * y.imag() - y.real() * x.imag()) / square};
}
template <int N>
Lanes<N> arc_tangent(const Lanes<N>& y, const Lanes<N>& x) {
  return atan2(y, x);
}

/// The nearest integer, without derivative. Ties round to an even number, as in compiled code
/// (Operation::kRound).
template <class T>
T nearest_integer(const T& x) {
  return T(std::nearbyint(value_of(x)));
}

/// The whole turns, a multiple of 2 pi [rad], that bring `angle` nearest to `reference` when added
/// to it. They have no derivative. Ties round to an even number of turns.
template <class T>
T nearest_turns(double reference, const T& angle) {
  return T(2.0 * M_PI) * nearest_integer(T((T(reference) - angle) / T(2.0 * M_PI)));
}

/// tanh(sqrt x)/sqrt x for x >= 0: analytic in x, 1 at zero; theory (13a). Below x = 0.05 the
/// series of the hyperbolic tangent is used, so that the relative errors of the value and of its
/// derivative stay below 1e-14.
template <class T>
T tanh_ratio(const T& x) {
  using std::sqrt;
  using std::tanh;
  constexpr double kSeriesBelow = 0.05;  // the series' terms fall like (4 x/pi^2)^k
  constexpr double kSeries[] = {1.0,
                                -1.0 / 3.0,
                                2.0 / 15.0,
                                -17.0 / 315.0,
                                62.0 / 2835.0,
                                -1382.0 / 155925.0,
                                21844.0 / 6081075.0,
                                -929569.0 / 638512875.0,
                                6404582.0 / 10854718875.0,
                                -443861162.0 / 1856156927625.0,
                                18888466084.0 / 194896477400625.0};
  if (!is_less(x, T(kSeriesBelow), false)) {
    const T root = sqrt(x);
    return tanh(root) / root;
  }
  T sum(kSeries[10]);
  for (int k = 9; k >= 0; --k) sum = sum * x + T(kSeries[k]);
  return sum;
}

}  // namespace codesign
