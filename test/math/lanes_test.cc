// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/lanes.h"

#include <gtest/gtest.h>

#include <complex>

#include "math/scalar.h"

namespace codesign {
namespace {

using L = Lanes<4>;
using C = std::complex<double>;
constexpr double kStep = 1e-30;

/// Every lane must equal the derivative by the complex step, for a generic function of two
/// variables.
template <class F>
void expect_derivatives(const F& f, double x, double y) {
  L lx(x), ly(y);
  lx.v[0] = 1.0;
  ly.v[2] = 1.0;
  const L value = f(lx, ly);
  const double by_x = f(C(x, kStep), C(y)).imag() / kStep,
               by_y = f(C(x), C(y, kStep)).imag() / kStep;
  EXPECT_NEAR(value.a, f(C(x), C(y)).real(), 1e-14);
  EXPECT_NEAR(value.v[0], by_x, 1e-13 * (1.0 + std::abs(by_x)));
  EXPECT_NEAR(value.v[2], by_y, 1e-13 * (1.0 + std::abs(by_y)));
  EXPECT_EQ(value.v[1], 0.0);
}

TEST(Lanes, Arithmetic) {
  expect_derivatives([](auto x, auto y) { return x * y + x / y - (x - y) * x; }, 1.3, -0.7);
  expect_derivatives([](auto x, auto y) { return -x / (y * y) + decltype(x)(2.0) * y; }, 0.4, 2.1);
}

TEST(Lanes, Functions) {
  using std::asin;
  using std::cos;
  using std::exp;
  using std::sin;
  using std::sqrt;
  using std::tanh;
  expect_derivatives([](auto x, auto y) { return sqrt(x) * tanh(y); }, 1.7, 0.3);
  expect_derivatives([](auto x, auto y) { return sin(x) * cos(y) + exp(x * y); }, 0.6, -0.9);
  expect_derivatives([](auto x, auto y) { return log(x * x + y) * y; }, 0.6, 0.9);
  expect_derivatives([](auto x, auto y) { return asin(x) + y; }, 0.35, 1.0);
  expect_derivatives([](auto x, auto y) { return arc_tangent(y, x); }, -0.8, 0.5);
  expect_derivatives([](auto x, auto y) { return smooth_abs(x, y); }, -0.8, 0.01);
}

TEST(Lanes, DirectionsAreAMap) {
  L x(2.0);
  x.directions() << 1.0, 2.0, 3.0, 4.0;
  EXPECT_EQ(x.v[3], 4.0);
  x.directions() += Eigen::Vector4d::Ones();
  EXPECT_EQ(x.v[0], 2.0);
}

}  // namespace
}  // namespace codesign
