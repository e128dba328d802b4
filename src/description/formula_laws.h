// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include "codegen/traced.h"
#include "description/expression.h"
#include "math/scalar.h"
#include "math/taylor.h"

namespace codesign {

// The smooth functions of expressions, for each scalar: smooth_function() for those of one number,
// power(), angle_of(), product() and quotient(). Functions with branches are in
// description/formula.h, ranges in description/value_range.h.

/// Whether a scalar is a value with derivatives: double, std::complex<double> and Lanes. Their laws
/// are value and slope, so that all have the value of the double to the last bit and derivatives
/// that are exact to first order, infinite where they are.
template <class T>
inline constexpr bool kHasSlope = false;
template <>
inline constexpr bool kHasSlope<double> = true;
template <>
inline constexpr bool kHasSlope<std::complex<double>> = true;
template <int N>
inline constexpr bool kHasSlope<Lanes<N>> = true;

/// `to` with the derivatives of x times a slope added. A derivative that is zero adds nothing, also
/// where the slope is infinite or undefined. @param slope () -> double, not called if none is
/// needed.
template <class Slope>
double add_slope(double to, double, const Slope&) {
  return to;
}
template <class Slope>
std::complex<double> add_slope(std::complex<double> to, const std::complex<double>& x,
                               const Slope& slope) {
  if (x.imag() != 0.0) to.imag(to.imag() + slope() * x.imag());
  return to;
}
template <int N, class Slope>
Lanes<N> add_slope(Lanes<N> to, const Lanes<N>& x, const Slope& slope) {
  bool any = false;
  for (int k = 0; k < N; ++k) any = any || x.v[k] != 0.0;
  if (!any) return to;
  const double s = slope();
  if (std::isfinite(s)) {
    to.v += x.v * s;
  } else {
    for (int k = 0; k < N; ++k)
      if (x.v[k] != 0.0) to.v[k] += s * x.v[k];
  }
  return to;
}

// x y and x / y.

template <class T>
T product(const T& x, const T& y) {
  if constexpr (kHasSlope<T>) {
    const double a = value_of(x), b = value_of(y);
    return add_slope(add_slope(T{a * b}, x, [b] { return b; }), y, [a] { return a; });
  } else {
    return x * y;
  }
}

template <class T>
T quotient(const T& x, const T& y) {
  if constexpr (kHasSlope<T>) {
    const double a = value_of(x), b = value_of(y), ratio = a / b;
    return add_slope(add_slope(T{ratio}, x, [b] { return 1.0 / b; }), y,
                     [ratio, b] { return -ratio / b; });
  } else {
    return x / y;
  }
}

/// x where the logarithm of x exists, else NaN.
inline double inside(double x) {
  return x < 0.0 ? std::numeric_limits<double>::quiet_NaN() : std::abs(x);
}

/// A function of one number by value and slope.
template <class T>
T sloped_function(FunctionKind kind, const T& x) {
  using K = FunctionKind;
  const double a = value_of(x);
  const auto law = [&x](double value, const auto& slope) { return add_slope(T{value}, x, slope); };
  switch (kind) {
    case K::kSquareRoot: {
      const double root = std::sqrt(a);
      return law(root, [root] { return 0.5 / std::abs(root); });  // of -0, too
    }
    case K::kSine:
      return law(std::sin(a), [a] { return std::cos(a); });
    case K::kCosine:
      return law(std::cos(a), [a] { return -std::sin(a); });
    case K::kTangent: {
      const double t = std::tan(a);
      return law(t, [t] { return 1.0 + t * t; });
    }
    case K::kArcSine:
      return law(std::asin(a), [a] { return 1.0 / std::sqrt((1.0 - a) * (1.0 + a)); });
    case K::kArcCosine:
      return law(std::acos(a), [a] { return -1.0 / std::sqrt((1.0 - a) * (1.0 + a)); });
    case K::kArcTangent:
      return law(std::atan(a), [a] { return 1.0 / (1.0 + a * a); });
    case K::kHyperbolicSine:
      return law(std::sinh(a), [a] { return std::cosh(a); });
    case K::kHyperbolicCosine:
      return law(std::cosh(a), [a] { return std::sinh(a); });
    case K::kHyperbolicTangent: {
      const double t = std::tanh(a);
      return law(t, [t] { return (1.0 - t) * (1.0 + t); });
    }
    case K::kExponential: {
      const double e = std::exp(a);
      return law(e, [e] { return e; });
    }
    case K::kLogarithm:
      return law(std::log(a), [a] { return 1.0 / inside(a); });
    case K::kLogarithm10:
      return law(std::log10(a), [a] { return 1.0 / (inside(a) * M_LN10); });
    case K::kRadians:
      return law(a * (M_PI / 180.0), [] { return M_PI / 180.0; });
    default:
      return law(a * (180.0 / M_PI), [] { return 180.0 / M_PI; });
  }
}

/// The same for recordings and series, from the functions that they have.
template <class T>
T composed_function(FunctionKind kind, const T& x) {
  using std::asin, std::cos, std::exp, std::log, std::sin, std::sqrt, std::tanh;
  using K = FunctionKind;
  const T one(1.0), half(0.5);
  switch (kind) {
    case K::kSquareRoot:
      return sqrt(x);
    case K::kSine:
      return sin(x);
    case K::kCosine:
      return cos(x);
    case K::kTangent:
      return sin(x) / cos(x);
    case K::kArcSine:
      return asin(x);
    case K::kArcCosine:
      return arc_tangent(sqrt((one - x) * (one + x)), x);
    case K::kArcTangent:
      return arc_tangent(x, one);
    case K::kHyperbolicSine:  // exp(x) - exp(-x) would cancel near zero
      return tanh(x) * (half * (exp(x) + exp(-x)));
    case K::kHyperbolicCosine:
      return half * (exp(x) + exp(-x));
    case K::kHyperbolicTangent:
      return tanh(x);
    case K::kExponential:
      return exp(x);
    case K::kLogarithm:
      return log(x);
    case K::kLogarithm10:
      return log(x) * T(1.0 / M_LN10);
    case K::kRadians:
      return x * T(M_PI / 180.0);
    default:
      return x * T(180.0 / M_PI);
  }
}

/// A smooth function of one number: all but atan2 and pow.
template <class T>
T smooth_function(FunctionKind kind, const T& x) {
  if constexpr (kHasSlope<T>)
    return sloped_function(kind, x);
  else
    return composed_function(kind, x);
}

/// atan2(y, x) [rad].
template <class T>
T angle_of(const T& y, const T& x) {
  if constexpr (kHasSlope<T>) {
    const double a = value_of(y), b = value_of(x), square = a * a + b * b;
    return add_slope(add_slope(T{std::atan2(a, b)}, y, [=] { return b / square; }), x,
                     [=] { return -a / square; });
  } else {
    return arc_tangent(y, x);
  }
}

/// base^exponent. The derivative by the base is that of a product for whole exponents, also at zero
/// and for negative bases; that by the exponent, x^n log x, does not exist for negative bases.
template <class T>
T power(const T& base, const T& exponent) {
  const double x = value_of(base), n = value_of(exponent), value = std::pow(x, n);
  return add_slope(
      add_slope(T{value}, base, [=] { return n == 0.0 ? 0.0 : n * std::pow(x, n - 1.0); }),
      exponent, [=] { return x == 0.0 && n > 0.0 ? 0.0 : value * std::log(x); });
}
/// As products where the exponent is a whole number, a literal or one of the design, else
/// exp(exponent log base), which needs a positive base.
Traced power(const Traced& base, const Traced& exponent);

// Series. One that does not change in time is a number, so that it has the laws of numbers.

inline bool is_zero(double x) { return x == 0.0; }
inline bool is_zero(const std::complex<double>& x) { return x == 0.0; }
inline bool is_zero(const Traced& x) { return x.is(0.0); }
template <int N>
bool is_zero(const Lanes<N>& x) {
  bool zero = x.a == 0.0;
  for (int k = 0; k < N; ++k) zero = zero && x.v[k] == 0.0;
  return zero;
}

template <class T>
bool is_constant(const Taylor<T>& x) {
  for (std::size_t k = 1; k < Taylor<T>::kTerms; ++k)
    if (!is_zero(x.c[k])) return false;
  return true;
}

template <class T>
bool is_zero(const Taylor<T>& x) {
  return is_constant(x) && is_zero(x.c[0]);
}

template <class T>
Taylor<T> product(const Taylor<T>& x, const Taylor<T>& y) {
  if (is_constant(x) && is_constant(y)) return Taylor<T>(product(x.c[0], y.c[0]));
  return x * y;
}
template <class T>
Taylor<T> quotient(const Taylor<T>& x, const Taylor<T>& y) {
  if (is_constant(x) && is_constant(y)) return Taylor<T>(quotient(x.c[0], y.c[0]));
  return x / y;
}
template <class T>
Taylor<T> smooth_function(FunctionKind kind, const Taylor<T>& x) {
  if (is_constant(x)) return Taylor<T>(smooth_function(kind, x.c[0]));
  return composed_function(kind, x);
}
template <class T>
Taylor<T> angle_of(const Taylor<T>& y, const Taylor<T>& x) {
  if (is_constant(x) && is_constant(y)) return Taylor<T>(angle_of(y.c[0], x.c[0]));
  return arc_tangent(y, x);
}

/// x^n with an exponent that does not change: (x^n)' = n x^(n-1) x', in which each power needs one
/// term less than the one before.
template <class T>
Taylor<T> constant_power(const Taylor<T>& x, const T& n, std::size_t terms) {
  const T value = power(x.c[0], n);
  if (terms == 1 || is_zero(n)) return Taylor<T>(value);
  if constexpr (kHasSlope<T>)
    // n x^(n-1) is zero there too; only its derivative by n, which is infinite at this one instant,
    // is left out.
    if (value_of(n) == 0.0 && value_of(x.c[0]) == 0.0) return Taylor<T>(value);
  const Taylor<T> slope = Taylor<T>(n) * constant_power(x, T(n - T(1.0)), terms - 1);
  return Taylor<T>::along(x, value, slope);
}
template <class T>
Taylor<T> power(const Taylor<T>& base, const Taylor<T>& exponent) {
  if (is_constant(base) && is_constant(exponent)) return Taylor<T>(power(base.c[0], exponent.c[0]));
  if (is_constant(exponent)) return constant_power(base, exponent.c[0], Taylor<T>::kTerms);
  return exp(exponent * smooth_function(FunctionKind::kLogarithm, base));
}

}  // namespace codesign
