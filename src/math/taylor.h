// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/scalar.h"

namespace codesign {

/// A function of time near one instant as its Taylor polynomial sum c_k tau^k to the third degree.
/// The operations are those of power series (Griewank and Walther, Evaluating Derivatives, 2008,
/// section 13.2). T: double, std::complex<double>, Lanes<N> or Traced.
template <class T>
struct Taylor {
  static constexpr std::size_t kTerms = 4;
  std::array<T, kTerms> c{T(0.0), T(0.0), T(0.0), T(0.0)};

  Taylor() = default;
  explicit Taylor(const T& constant) { c[0] = constant; }
  /// The time t itself.
  static Taylor time(const T& t) {
    Taylor x{t};
    x.c[1] = T(1.0);
    return x;
  }

  friend Taylor operator-(const Taylor& x) {
    Taylor r;
    for (std::size_t k = 0; k < kTerms; ++k) r.c[k] = -x.c[k];
    return r;
  }
  friend Taylor operator+(const Taylor& x, const Taylor& y) {
    Taylor r;
    for (std::size_t k = 0; k < kTerms; ++k) r.c[k] = x.c[k] + y.c[k];
    return r;
  }
  friend Taylor operator-(const Taylor& x, const Taylor& y) { return x + -y; }
  friend Taylor operator*(const Taylor& x, const Taylor& y) {
    Taylor r;
    for (std::size_t k = 0; k < kTerms; ++k)
      for (std::size_t j = 0; j <= k; ++j) r.c[k] += x.c[j] * y.c[k - j];
    return r;
  }
  friend Taylor operator/(const Taylor& x, const Taylor& y) {
    Taylor r;
    for (std::size_t k = 0; k < kTerms; ++k) {
      T sum = x.c[k];
      for (std::size_t j = 1; j <= k; ++j) sum -= y.c[j] * r.c[k - j];
      r.c[k] = sum / y.c[0];
    }
    return r;
  }

  /// The function with the value `value` and the rate g(tau) x'(tau): k r_k is the sum of j x_j
  /// g_(k-j). @param slope (k, r) -> g_k from the coefficients of r up to k
  template <class Slope>
  static Taylor along(const Taylor& x, const T& value, const Slope& slope) {
    Taylor r(value), g;
    for (std::size_t k = 1; k < kTerms; ++k) {
      g.c[k - 1] = slope(k - 1, r);
      for (std::size_t j = 1; j <= k; ++j)
        r.c[k] += T(static_cast<double>(j) / static_cast<double>(k)) * x.c[j] * g.c[k - j];
    }
    return r;
  }
  /// The same with a known g.
  static Taylor along(const Taylor& x, const T& value, const Taylor& slope) {
    return along(x, value, [&slope](std::size_t k, const Taylor&) { return slope.c[k]; });
  }

  friend Taylor exp(const Taylor& x) {
    using std::exp;
    return along(x, exp(x.c[0]), [](std::size_t k, const Taylor& r) { return r.c[k]; });
  }
  friend Taylor log(const Taylor& x) {
    using std::log;
    return along(x, log(x.c[0]), Taylor(T(1.0)) / x);
  }
  friend Taylor tanh(const Taylor& x) {
    using std::tanh;
    return along(x, tanh(x.c[0]),
                 [](std::size_t k, const Taylor& r) { return (Taylor(T(1.0)) - r * r).c[k]; });
  }
  friend Taylor sqrt(const Taylor& x) {
    using std::sqrt;
    Taylor r(sqrt(x.c[0]));
    for (std::size_t k = 1; k < kTerms; ++k) {
      T sum = x.c[k];
      for (std::size_t j = 1; j < k; ++j) sum -= r.c[j] * r.c[k - j];
      r.c[k] = sum / (T(2.0) * r.c[0]);
    }
    return r;
  }
  friend Taylor asin(const Taylor& x) {
    using std::asin;
    return along(x, asin(x.c[0]), Taylor(T(1.0)) / sqrt(Taylor(T(1.0)) - x * x));
  }
  friend Taylor sin(const Taylor& x) { return waves(x)[0]; }
  friend Taylor cos(const Taylor& x) { return waves(x)[1]; }
  /// atan2(y, x).
  friend Taylor arc_tangent(const Taylor& y, const Taylor& x) {
    const Taylor square = x * x + y * y, value(arc_tangent(y.c[0], x.c[0]));
    return along(y, value.c[0], x / square) - along(x, T(0.0), y / square);
  }
  friend double value_of(const Taylor& x) { return value_of(x.c[0]); }
  friend Taylor nearest_integer(const Taylor& x) { return Taylor(nearest_integer(x.c[0])); }
  friend Taylor whole_below(const Taylor& x) { return Taylor(whole_below(x.c[0])); }
  friend bool is_below(const Taylor& x, const Taylor& y, bool likely,
                       unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
    return is_below(x.c[0], y.c[0], likely, place);
  }
  friend bool takes_all_branches(const Taylor& x) {
    return std::any_of(x.c.begin(), x.c.end(), [](const T& c) { return takes_all_branches(c); });
  }
  friend void name_part(const Taylor& x, int part) { name_part(x.c[0], part); }
  friend bool is_less(const Taylor& x, const Taylor& y, bool likely,
                      unsigned place = place_in_source(__builtin_FILE(), __builtin_LINE())) {
    return is_less(x.c[0], y.c[0], likely, place);
  }

 private:
  /// sin x and cos x, each the slope of the other.
  static std::array<Taylor, 2> waves(const Taylor& x) {
    using std::cos, std::sin;
    Taylor s(sin(x.c[0])), c(cos(x.c[0]));
    for (std::size_t k = 1; k < kTerms; ++k)
      for (std::size_t j = 1; j <= k; ++j) {
        const T share = T(static_cast<double>(j) / static_cast<double>(k)) * x.c[j];
        s.c[k] += share * c.c[k - j];
        c.c[k] -= share * s.c[k - j];
      }
    return {s, c};
  }
};

}  // namespace codesign
