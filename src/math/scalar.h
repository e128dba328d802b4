// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
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
  CODESIGN_INLINE friend Lanes log(const Lanes& x) { return {std::log(x.a), x.v / x.a}; }
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

/// Cross product that works for every scalar type.
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return Vector3<T>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]);
}

/// Dot product without conjugation (Eigen's dot conjugates, which would break the complex step).
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

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

/// is_less() where the formula has a kink or a jump: a switch. Integrators hold the outcome of a
/// switch during a step, and end a step where it changes; doc/theory.md (17d).
template <class T>
bool is_below(const T& x, const T& y, bool likely,
              unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
  return is_less(x, y, likely, place);
}

/// is_below() where the formula has a kink by its form, as max(x - y, 0) has: in all states and
/// designs it is continuous there, so that what jumps is rounding.
template <class T>
bool is_below_kink(const T& x, const T& y, bool likely,
                   unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
  return is_less(x, y, likely, place);
}

/// While it lives, recordings name their switches after `source`, an object that stays where it is:
/// an expression, a joint's stops. For all scalars but Traced it does nothing. @param x a number
/// of the recording; of a literal nothing is recorded.
template <class T>
struct NamedSwitches {
  template <class Source>
  NamedSwitches(const T& x, const Source& source) {
    static_cast<void>(x), static_cast<void>(source);
  }
};
/// Whether a formula is to give the sum of what its branches give; only of recordings, to see all
/// that it can depend on.
template <class T>
bool takes_all_branches(const T&) {
  return false;
}
/// Which part of that object decides next: the operation of an expression, a law's decision.
template <class T>
void name_part(const T&, int) {}

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

/// The largest whole number that is not above x, without derivative; a switch at each whole number.
template <class T>
T whole_below(const T& x) {
  return T(std::floor(value_of(x)));
}

/// Tells a recording that x is the value of an expression of the study, which may vary within a
/// step as nothing else does; for other numbers nothing.
template <class T>
void note_expression(const T&) {}

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
