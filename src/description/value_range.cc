// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/value_range.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "description/expression.h"

namespace codesign {
namespace {

/// The range from the least to the greatest of some results; all numbers if one is undefined, such
/// as 0 * infinity.
ValueRange range_of(std::initializer_list<double> results) {
  if (std::any_of(results.begin(), results.end(), [](double x) { return std::isnan(x); }))
    return {};
  return {std::min(results), std::max(results)};
}

/// A function that nowhere turns round; all numbers if it has no value at an end.
template <class Function>
ValueRange monotone(const ValueRange& x, const Function& function) {
  return range_of({function(x.lower), function(x.upper)});
}

/// The range of the sine, or with the phase pi/2 of the cosine.
ValueRange wave(const ValueRange& x, double phase, double (*function)(double)) {
  if (!std::isfinite(x.lower) || !std::isfinite(x.upper)) return {-1.0, 1.0};
  // Whether x contains extremum + 2 pi k for some k.
  const auto reaches = [&x](double extremum) {
    const double turns = std::ceil((x.lower - extremum) / (2.0 * M_PI));
    return extremum + turns * 2.0 * M_PI <= x.upper;
  };
  ValueRange result = range_of({function(x.lower), function(x.upper)});
  if (reaches(0.5 * M_PI - phase)) result.upper = 1.0;
  if (reaches(-0.5 * M_PI - phase)) result.lower = -1.0;
  return result;
}

ValueRange tangent(const ValueRange& x) {
  const double pole = (std::ceil(x.lower / M_PI - 0.5) + 0.5) * M_PI;
  if (!(x.upper - x.lower < M_PI) || x.holds(pole)) return {};
  return range_of({std::tan(x.lower), std::tan(x.upper)});
}

/// The angle jumps at the negative half of the axis of x.
ValueRange arc_tangent(const ValueRange& y, const ValueRange& x) {
  if (x.lower <= 0.0 && y.holds(0.0) && !(x.is_number() && y.is_number())) return {-M_PI, M_PI};
  return range_of({std::atan2(y.lower, x.lower), std::atan2(y.lower, x.upper),
                   std::atan2(y.upper, x.lower), std::atan2(y.upper, x.upper)});
}

ValueRange magnitude(const ValueRange& x) {
  const double low = std::abs(x.lower), high = std::abs(x.upper);
  return {x.holds(0.0) ? 0.0 : std::min(low, high), std::max(low, high)};
}

double sign(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

ValueRange extreme(const ValueRange* z, int count, bool largest) {
  ValueRange best = z[0];
  for (int k = 1; k < count; ++k) {
    best.lower = largest ? std::max(best.lower, z[k].lower) : std::min(best.lower, z[k].lower);
    best.upper = largest ? std::max(best.upper, z[k].upper) : std::min(best.upper, z[k].upper);
  }
  return best;
}

}  // namespace

ValueRange operator-(const ValueRange& x) { return {-x.upper, -x.lower}; }
ValueRange operator+(const ValueRange& x, const ValueRange& y) {
  return range_of({x.lower + y.lower, x.upper + y.upper});
}
ValueRange operator-(const ValueRange& x, const ValueRange& y) {
  return range_of({x.lower - y.upper, x.upper - y.lower});
}
ValueRange product(const ValueRange& x, const ValueRange& y) {
  return range_of({x.lower * y.lower, x.lower * y.upper, x.upper * y.lower, x.upper * y.upper});
}
ValueRange quotient(const ValueRange& x, const ValueRange& y) {
  if (y.holds(0.0)) return {};
  return range_of({x.lower / y.lower, x.lower / y.upper, x.upper / y.lower, x.upper / y.upper});
}

ValueRange hull(const ValueRange& x, const ValueRange& y) {
  return {std::min(x.lower, y.lower), std::max(x.upper, y.upper)};
}

ValueRange power(const ValueRange& base, const ValueRange& exponent) {
  const double n = exponent.lower;
  const auto of = [](double x, double m) { return std::pow(x, m); };
  if (exponent.is_number() && std::nearbyint(n) == n) {
    const bool is_even = std::fmod(n, 2.0) == 0.0;
    if (n < 0.0 && base.holds(0.0)) return {};
    const ValueRange x = is_even ? magnitude(base) : base;
    return range_of({of(x.lower, n), of(x.upper, n)});
  }
  if (!(base.lower >= 0.0)) return {};
  // Monotone in the base and in the exponent.
  return range_of({of(base.lower, exponent.lower), of(base.lower, exponent.upper),
                   of(base.upper, exponent.lower), of(base.upper, exponent.upper)});
}

ValueRange formula_function(FunctionKind kind, const ValueRange* z, int count) {
  using K = FunctionKind;
  const ValueRange& x = z[0];
  const auto over = [&x](double (*function)(double)) { return monotone(x, function); };
  switch (kind) {
    case K::kSquareRoot:
      return over(std::sqrt);
    case K::kSine:
      return wave(x, 0.0, std::sin);
    case K::kCosine:
      return wave(x, 0.5 * M_PI, std::cos);
    case K::kTangent:
      return tangent(x);
    case K::kArcSine:
      return over(std::asin);
    case K::kArcCosine:
      return over(std::acos);
    case K::kArcTangent:
      return over(std::atan);
    case K::kArcTangent2:
      return arc_tangent(x, z[1]);
    case K::kHyperbolicSine:
      return over(std::sinh);
    case K::kHyperbolicCosine:
      return monotone(magnitude(x), [](double y) { return std::cosh(y); });
    case K::kHyperbolicTangent:
      return over(std::tanh);
    case K::kExponential:
      return over(std::exp);
    case K::kLogarithm:
      return over(std::log);
    case K::kLogarithm10:
      return over(std::log10);
    case K::kPower:
      return power(x, z[1]);
    case K::kMagnitude:
      return magnitude(x);
    case K::kSign:
      return over(sign);
    case K::kLeast:
    case K::kGreatest:
      return extreme(z, count, kind == K::kGreatest);
    case K::kFloor:
      return over(std::floor);
    case K::kCeiling:
      return over(std::ceil);
    case K::kRadians:
      return product(x, M_PI / 180.0);
    case K::kDegrees:
      break;
  }
  return product(x, 180.0 / M_PI);
}

ValueRange less(const ValueRange& x, const ValueRange& y) {
  return {x.upper < y.lower ? 1.0 : 0.0, x.lower < y.upper ? 1.0 : 0.0};
}
ValueRange equal(const ValueRange& x, const ValueRange& y) {
  const bool always = x.is_number() && y.is_number() && x.lower == y.lower,
             possible = x.lower <= y.upper && y.lower <= x.upper;
  return {always ? 1.0 : 0.0, possible ? 1.0 : 0.0};
}

}  // namespace codesign
