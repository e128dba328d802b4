// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace codesign {

// Every operation takes a few instructions, fewer than a call; there are so many operations that
// the compiler would not inline all of them by itself.
#define CODESIGN_INLINE __attribute__((always_inline)) inline

/// A value with N directional derivatives side by side in SIMD registers: forward-mode automatic
/// differentiation of N parameters in one pass.
///
/// Plain arithmetic on the compiler's vector type, all inlined; doc/decisions/0003-lanes.md
/// explains why no library's dual number is used. Like a double, it is uninitialized after default
/// construction. Comparisons compare the values.
template <int N>
struct Lanes {
  static_assert(N % 4 == 0, "lanes come in fours");
  static constexpr int kBlocks = N / 4;

  /// Four derivatives. Aligned as a double, so that containers need no special allocator.
  typedef double Four __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double))));

  /// N derivatives in blocks of four, each in one register; a single vector type of N numbers would
  /// be kept in memory.
  struct Vector {
    Four block[kBlocks];

    CODESIGN_INLINE double& operator[](int k) { return reinterpret_cast<double*>(block)[k]; }
    CODESIGN_INLINE double operator[](int k) const {
      return reinterpret_cast<const double*>(block)[k];
    }

    CODESIGN_INLINE friend Vector operator-(const Vector& x) {
      Vector r;
      for (int k = 0; k < kBlocks; ++k) r.block[k] = -x.block[k];
      return r;
    }
    CODESIGN_INLINE friend Vector operator+(const Vector& x, const Vector& y) {
      Vector r;
      for (int k = 0; k < kBlocks; ++k) r.block[k] = x.block[k] + y.block[k];
      return r;
    }
    CODESIGN_INLINE friend Vector operator-(const Vector& x, const Vector& y) {
      Vector r;
      for (int k = 0; k < kBlocks; ++k) r.block[k] = x.block[k] - y.block[k];
      return r;
    }
    CODESIGN_INLINE friend Vector operator*(const Vector& x, double f) {
      Vector r;
      for (int k = 0; k < kBlocks; ++k) r.block[k] = x.block[k] * f;
      return r;
    }
    CODESIGN_INLINE friend Vector operator*(double f, const Vector& x) { return x * f; }
    CODESIGN_INLINE friend Vector operator/(const Vector& x, double f) { return x * (1.0 / f); }
    CODESIGN_INLINE Vector& operator+=(const Vector& y) { return *this = *this + y; }
    CODESIGN_INLINE Vector& operator-=(const Vector& y) { return *this = *this - y; }
  };

  double a;  ///< value
  Vector v;  ///< derivatives

  Lanes() = default;
  CODESIGN_INLINE Lanes(double value)
      : a(value),
        v{} {}  // NOLINT(google-explicit-constructor): numbers mix with lanes in every formula
  CODESIGN_INLINE Lanes(double value, const Vector& derivatives) : a(value), v(derivatives) {}

  using Map = Eigen::Map<Eigen::Matrix<double, N, 1>>;
  using ConstMap = Eigen::Map<const Eigen::Matrix<double, N, 1>>;
  /// The derivatives as a vector.
  CODESIGN_INLINE Map directions() { return Map(reinterpret_cast<double*>(&v)); }
  CODESIGN_INLINE ConstMap directions() const {
    return ConstMap(reinterpret_cast<const double*>(&v));
  }

  CODESIGN_INLINE Lanes& operator+=(const Lanes& y) {
    a += y.a;
    v += y.v;
    return *this;
  }
  CODESIGN_INLINE Lanes& operator-=(const Lanes& y) {
    a -= y.a;
    v -= y.v;
    return *this;
  }
  CODESIGN_INLINE Lanes& operator*=(const Lanes& y) {
    v = v * y.a + a * y.v;
    a *= y.a;
    return *this;
  }
  CODESIGN_INLINE Lanes& operator/=(const Lanes& y) { return *this = *this / y; }

  CODESIGN_INLINE friend Lanes operator+(const Lanes& x) { return x; }
  CODESIGN_INLINE friend Lanes operator-(const Lanes& x) { return {-x.a, -x.v}; }
  CODESIGN_INLINE friend Lanes operator+(const Lanes& x, const Lanes& y) {
    return {x.a + y.a, x.v + y.v};
  }
  CODESIGN_INLINE friend Lanes operator-(const Lanes& x, const Lanes& y) {
    return {x.a - y.a, x.v - y.v};
  }
  CODESIGN_INLINE friend Lanes operator*(const Lanes& x, const Lanes& y) {
    return {x.a * y.a, x.v * y.a + x.a * y.v};
  }
  CODESIGN_INLINE friend Lanes operator/(const Lanes& x, const Lanes& y) {
    const double inverse = 1.0 / y.a, quotient = x.a * inverse;
    return {quotient, (x.v - quotient * y.v) * inverse};
  }
  // With a constant, the products by its derivatives, which are zero, are left out.
  CODESIGN_INLINE friend Lanes operator+(const Lanes& x, double y) { return {x.a + y, x.v}; }
  CODESIGN_INLINE friend Lanes operator+(double x, const Lanes& y) { return {x + y.a, y.v}; }
  CODESIGN_INLINE friend Lanes operator-(const Lanes& x, double y) { return {x.a - y, x.v}; }
  CODESIGN_INLINE friend Lanes operator-(double x, const Lanes& y) { return {x - y.a, -y.v}; }
  CODESIGN_INLINE friend Lanes operator*(const Lanes& x, double y) { return {x.a * y, x.v * y}; }
  CODESIGN_INLINE friend Lanes operator*(double x, const Lanes& y) { return {x * y.a, x * y.v}; }
  CODESIGN_INLINE friend Lanes operator/(const Lanes& x, double y) { return x * (1.0 / y); }
  CODESIGN_INLINE friend bool operator<(const Lanes& x, const Lanes& y) { return x.a < y.a; }
  CODESIGN_INLINE friend bool operator>(const Lanes& x, const Lanes& y) { return x.a > y.a; }
  CODESIGN_INLINE friend bool operator<=(const Lanes& x, const Lanes& y) { return x.a <= y.a; }
  CODESIGN_INLINE friend bool operator>=(const Lanes& x, const Lanes& y) { return x.a >= y.a; }
  CODESIGN_INLINE friend bool operator==(const Lanes& x, const Lanes& y) { return x.a == y.a; }
  CODESIGN_INLINE friend bool operator!=(const Lanes& x, const Lanes& y) { return x.a != y.a; }

  CODESIGN_INLINE friend Lanes sqrt(const Lanes& x) {
    const double root = std::sqrt(x.a);
    return {root, x.v * (0.5 / root)};
  }
  CODESIGN_INLINE friend Lanes abs(const Lanes& x) { return x.a < 0.0 ? -x : x; }
  CODESIGN_INLINE friend Lanes sin(const Lanes& x) { return {std::sin(x.a), x.v * std::cos(x.a)}; }
  CODESIGN_INLINE friend Lanes cos(const Lanes& x) { return {std::cos(x.a), x.v * -std::sin(x.a)}; }
  CODESIGN_INLINE friend Lanes asin(const Lanes& x) {
    return {std::asin(x.a), x.v / std::sqrt(1.0 - x.a * x.a)};
  }
  CODESIGN_INLINE friend Lanes tanh(const Lanes& x) {
    const double t = std::tanh(x.a);
    return {t, x.v * (1.0 - t * t)};
  }
  CODESIGN_INLINE friend Lanes exp(const Lanes& x) {
    const double e = std::exp(x.a);
    return {e, x.v * e};
  }
  CODESIGN_INLINE friend Lanes log(const Lanes& x) { return {std::log(x.a), x.v * (1.0 / x.a)}; }
  CODESIGN_INLINE friend Lanes atan2(const Lanes& y, const Lanes& x) {
    const double inverse = 1.0 / (x.a * x.a + y.a * y.a);
    return {std::atan2(y.a, x.a), y.v * (x.a * inverse) - x.v * (y.a * inverse)};
  }
};

#undef CODESIGN_INLINE

}  // namespace codesign

namespace Eigen {

// The same costs as for double, so that Eigen unrolls the same small loops.
template <int N>
struct NumTraits<codesign::Lanes<N>> : GenericNumTraits<double> {
  using Real = codesign::Lanes<N>;
  using NonInteger = codesign::Lanes<N>;
  using Nested = codesign::Lanes<N>;
  using Literal = codesign::Lanes<N>;
  static Real dummy_precision() { return Real(1e-12); }
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

template <int N, class Operation>
struct ScalarBinaryOpTraits<codesign::Lanes<N>, double, Operation> {
  using ReturnType = codesign::Lanes<N>;
};
template <int N, class Operation>
struct ScalarBinaryOpTraits<double, codesign::Lanes<N>, Operation> {
  using ReturnType = codesign::Lanes<N>;
};

}  // namespace Eigen
