// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#ifndef MECHANISM_CODESIGN_MATH_LANES_H_
#define MECHANISM_CODESIGN_MATH_LANES_H_

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace codesign {

/// A value with N directional derivatives side by side in SIMD registers: forward-mode automatic differentiation of N parameters in one pass.
///
/// Plain arithmetic on the compiler's vector type, all inlined; why not a library's dual number: doc/decisions/0003-lanes.md.
template <int N>
struct Lanes {
  // Aligned as a double, so that containers need no special allocator.
  typedef double Vector __attribute__((vector_size(N * sizeof(double)), aligned(sizeof(double))));

  double a = 0.0;  ///< value
  Vector v{};      ///< derivatives

  Lanes() = default;
  Lanes(double value) : a(value) {}  // NOLINT(google-explicit-constructor): numbers mix with lanes in every formula
  Lanes(double value, const Vector& derivatives) : a(value), v(derivatives) {}

  using Map = Eigen::Map<Eigen::Matrix<double, N, 1>>;
  using ConstMap = Eigen::Map<const Eigen::Matrix<double, N, 1>>;
  /// The derivatives as a vector.
  Map directions() { return Map(reinterpret_cast<double*>(&v)); }
  ConstMap directions() const { return ConstMap(reinterpret_cast<const double*>(&v)); }

  Lanes& operator+=(const Lanes& y) {
    a += y.a;
    v += y.v;
    return *this;
  }
  Lanes& operator-=(const Lanes& y) {
    a -= y.a;
    v -= y.v;
    return *this;
  }
  Lanes& operator*=(const Lanes& y) {
    v = v * y.a + a * y.v;
    a *= y.a;
    return *this;
  }
  Lanes& operator/=(const Lanes& y) { return *this = *this / y; }

  friend Lanes operator+(const Lanes& x) { return x; }
  friend Lanes operator-(const Lanes& x) { return {-x.a, -x.v}; }
  friend Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.v + y.v}; }
  friend Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.v - y.v}; }
  friend Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.v * y.a + x.a * y.v}; }
  friend Lanes operator/(const Lanes& x, const Lanes& y) {
    const double inverse = 1.0 / y.a, quotient = x.a * inverse;
    return {quotient, (x.v - quotient * y.v) * inverse};
  }
  friend bool operator<(const Lanes& x, const Lanes& y) { return x.a < y.a; }
  friend bool operator>(const Lanes& x, const Lanes& y) { return x.a > y.a; }
  friend bool operator<=(const Lanes& x, const Lanes& y) { return x.a <= y.a; }
  friend bool operator>=(const Lanes& x, const Lanes& y) { return x.a >= y.a; }
  friend bool operator==(const Lanes& x, const Lanes& y) { return x.a == y.a; }
  friend bool operator!=(const Lanes& x, const Lanes& y) { return x.a != y.a; }

  friend Lanes sqrt(const Lanes& x) {
    const double root = std::sqrt(x.a);
    return {root, x.v * (0.5 / root)};
  }
  friend Lanes abs(const Lanes& x) { return x.a < 0.0 ? -x : x; }
  friend Lanes sin(const Lanes& x) { return {std::sin(x.a), x.v * std::cos(x.a)}; }
  friend Lanes cos(const Lanes& x) { return {std::cos(x.a), x.v * -std::sin(x.a)}; }
  friend Lanes asin(const Lanes& x) { return {std::asin(x.a), x.v / std::sqrt(1.0 - x.a * x.a)}; }
  friend Lanes tanh(const Lanes& x) {
    const double t = std::tanh(x.a);
    return {t, x.v * (1.0 - t * t)};
  }
  friend Lanes exp(const Lanes& x) {
    const double e = std::exp(x.a);
    return {e, x.v * e};
  }
  friend Lanes atan2(const Lanes& y, const Lanes& x) {
    const double inverse = 1.0 / (x.a * x.a + y.a * y.a);
    return {std::atan2(y.a, x.a), y.v * (x.a * inverse) - x.v * (y.a * inverse)};
  }
};

}  // namespace codesign

namespace Eigen {

template <int N>
struct NumTraits<codesign::Lanes<N>> : GenericNumTraits<double> {
  using Real = codesign::Lanes<N>;
  using NonInteger = codesign::Lanes<N>;
  using Nested = codesign::Lanes<N>;
  using Literal = codesign::Lanes<N>;
  static Real dummy_precision() { return Real(1e-12); }
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = N, AddCost = N, MulCost = 3 * N };
};

template <int N, class Operation>
struct ScalarBinaryOpTraits<codesign::Lanes<N>, double, Operation> {
  using ReturnType = codesign::Lanes<N>;
};
template <int N, class Operation>
struct ScalarBinaryOpTraits<double, codesign::Lanes<N>, Operation> {
  using ReturnType = codesign::Lanes<N>;
};

}  // namespace Eigen

#endif  // MECHANISM_CODESIGN_MATH_LANES_H_
