// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/taylor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "math/differences.h"

namespace codesign {
namespace {

using Series = Taylor<double>;

/// Compares value and derivatives of f at t with those of `plain`: each derivative with Ridders
/// differences of the one before it.
void expect_series(const std::function<Series(const Series&)>& f,
                   const std::function<double(double)>& plain, double t) {
  const auto term = [&](std::size_t k) {
    return [&f, k](double x) { return f(Series::time(x)).c[k]; };
  };
  EXPECT_NEAR(term(0)(t), plain(t), 1e-15 * (1.0 + std::abs(plain(t))));
  for (std::size_t k = 0; k + 1 < Series::kTerms; ++k) {
    const double next = static_cast<double>(k + 1) * term(k + 1)(t);
    EXPECT_NEAR(next, ridders_derivative(term(k), t, 1e-2).value, 1e-8 * (1.0 + std::abs(next)))
        << "order " << k + 1;
  }
}

TEST(Taylor, EveryFunctionHasItsDerivatives) {
  const auto inner = [](const Series& x) { return Series(0.3) + Series(0.4) * x * x; };
  const auto at = [](double x) { return 0.3 + 0.4 * x * x; };
  expect_series([&](const Series& x) { return exp(inner(x)); },
                [&](double x) { return std::exp(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return log(inner(x)); },
                [&](double x) { return std::log(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return sqrt(inner(x)); },
                [&](double x) { return std::sqrt(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return sin(inner(x)); },
                [&](double x) { return std::sin(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return cos(inner(x)); },
                [&](double x) { return std::cos(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return tanh(inner(x)); },
                [&](double x) { return std::tanh(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return asin(inner(x)); },
                [&](double x) { return std::asin(at(x)); }, 0.7);
  expect_series([&](const Series& x) { return arc_tangent(inner(x), x - Series(2.0)); },
                [&](double x) { return std::atan2(at(x), x - 2.0); }, 0.7);
  expect_series([&](const Series& x) { return (x - Series(3.0)) / inner(x) - x * x * x; },
                [&](double x) { return (x - 3.0) / at(x) - x * x * x; }, 0.7);
}

TEST(Taylor, CarriesDerivativesByParameters) {
  using L = Lanes<4>;
  const L frequency(2.0, L::Vector{1.0, 0.0, 0.0, 0.0});
  const Taylor<L> f = sin(Taylor<L>(frequency) * Taylor<L>::time(0.3));
  // d/dw of w cos(w t), the rate.
  EXPECT_NEAR(f.c[1].v[0], std::cos(0.6) - 0.6 * std::sin(0.6), 1e-15);
}

}  // namespace
}  // namespace codesign
