// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace codesign {

/// A value with one directional derivative: forward automatic differentiation as in textbooks, with
/// the operations that constraints need.
struct Dual {
  double a = 0.0;  ///< value
  double d = 0.0;  ///< derivative

  Dual() = default;
  Dual(double value, double derivative = 0.0)
      : a(value), d(derivative) {}  // NOLINT(google-explicit-constructor): mixes with numbers

  Dual& operator+=(const Dual& y) { return *this = *this + y; }
  Dual& operator-=(const Dual& y) { return *this = *this - y; }
  Dual& operator*=(const Dual& y) { return *this = *this * y; }

  friend Dual operator-(const Dual& x) { return {-x.a, -x.d}; }
  friend Dual operator+(const Dual& x, const Dual& y) { return {x.a + y.a, x.d + y.d}; }
  friend Dual operator-(const Dual& x, const Dual& y) { return {x.a - y.a, x.d - y.d}; }
  friend Dual operator*(const Dual& x, const Dual& y) { return {x.a * y.a, x.a * y.d + x.d * y.a}; }
};

}  // namespace codesign

namespace Eigen {

template <>
struct NumTraits<codesign::Dual> : GenericNumTraits<double> {
  using Real = codesign::Dual;
  using NonInteger = codesign::Dual;
  using Nested = codesign::Dual;
  using Literal = codesign::Dual;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

}  // namespace Eigen
