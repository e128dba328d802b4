// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/scalar.h"

#include <gtest/gtest.h>
#include <complex>

namespace codesign {
namespace {

TEST(ValueOf, DropsTheFirstOrderPart) {
  EXPECT_EQ(value_of(-1.5), -1.5);
  EXPECT_EQ(value_of(std::complex<double>(-1.5, 7.0)), -1.5);
  EXPECT_EQ(value_of(Lanes<4>(-1.5, Lanes<4>::Vector{1.0, 2.0, 3.0, 4.0})), -1.5);
}

TEST(Scalar, MatricesOfLanesMultiplyAsTheChainRuleSays) {
  using L = Lanes<4>;
  Matrix3<L> A = Matrix3<L>::Identity();
  A(0, 1) = L(2.0, L::Vector{1.0, 0.0, 0.0, 0.0});
  const Vector3<L> y = A * Vector3<L>(L(1.0), L(3.0, L::Vector{0.0, 1.0, 0.0, 0.0}), L(5.0));
  EXPECT_EQ(y[0].a, 7.0);
  EXPECT_EQ(y[0].v[0], 3.0);
  EXPECT_EQ(y[0].v[1], 2.0);
}

TEST(Directions, ImaginaryPartsAreOneColumn) {
  VectorX<std::complex<double>> x(2);
  x << std::complex<double>(1.0, 2.0), std::complex<double>(3.0, -4.0);
  EXPECT_EQ(directions_of(x), Eigen::Vector2d(2.0, -4.0));
  add_directions(Eigen::MatrixXd(Eigen::Vector2d(0.5, 1.0)), &x);
  EXPECT_EQ(x[0], std::complex<double>(1.0, 2.5));
  EXPECT_EQ(x[1], std::complex<double>(3.0, -3.0));
}

TEST(Directions, EachLaneIsAColumn) {
  using L = Lanes<4>;
  VectorX<L> x(2);
  x << L(1.0, L::Vector{1.0, 2.0, 3.0, 4.0}), L(2.0, L::Vector{5.0, 6.0, 7.0, 8.0});
  Eigen::MatrixXd expected(2, 4);
  expected << 1, 2, 3, 4, 5, 6, 7, 8;
  EXPECT_EQ(directions_of(x), expected);
  add_directions(Eigen::MatrixXd(-expected), &x);
  EXPECT_EQ(directions_of(x), Eigen::MatrixXd::Zero(2, 4));
  EXPECT_EQ(x[1].a, 2.0) << "the value stays";
}

using C = std::complex<double>;
constexpr double kStep = 1e-30;

TEST(SmoothAbs, IsEpsilonAtZeroAndTheModulusFarFromIt) {
  EXPECT_EQ(smooth_abs(0.0, 1e-3), 1e-3);
  EXPECT_EQ(smooth_abs(-3.0, 4.0), 5.0);
  EXPECT_NEAR(smooth_abs(-7.0, 1e-3), 7.0, 1e-7);
}

TEST(SmoothAbs, SlopeIsXOverItself) {
  EXPECT_NEAR(smooth_abs(C(-3.0, kStep), C(4.0)).imag() / kStep, -0.6, 1e-15);
  EXPECT_EQ(smooth_abs(C(0.0, kStep), C(4.0)).imag(), 0.0);
}

TEST(ArcTangent, ComplexValueAndSlopeInEveryQuadrant) {
  for (double x : {-0.8, 0.8}) {
    for (double y : {-0.6, 0.6}) {
      EXPECT_EQ(arc_tangent(C(y), C(x)).real(), std::atan2(y, x));
      // d atan2 = (x dy - y dx) / (x^2 + y^2), and x^2 + y^2 = 1.
      EXPECT_NEAR(arc_tangent(C(y, kStep), C(x)).imag() / kStep, x, 1e-15);
      EXPECT_NEAR(arc_tangent(C(y), C(x, kStep)).imag() / kStep, -y, 1e-15);
    }
  }
}

TEST(ArcTangent, LanesCarryTheSameSlope) {
  Lanes<4> y(0.6), x(-0.8);
  y.v[0] = 1.0;
  x.v[1] = 1.0;
  const Lanes<4> angle = arc_tangent(y, x);
  EXPECT_EQ(angle.a, std::atan2(0.6, -0.8));
  EXPECT_NEAR(angle.v[0], -0.8, 1e-15);
  EXPECT_NEAR(angle.v[1], -0.6, 1e-15);
}

/// The derivative, by the complex step.
double slope(double x) { return tanh_ratio(std::complex<double>(x, 1e-30)).imag() / 1e-30; }

TEST(TanhRatio, IsWhatItSays) {
  EXPECT_EQ(tanh_ratio(0.0), 1.0);
  EXPECT_NEAR(slope(0.0), -1.0 / 3.0, 1e-16);
  for (double x : {1e-4, 0.01, 0.0499, 0.0501, 1.0, 400.0}) {
    EXPECT_NEAR(tanh_ratio(x), std::tanh(std::sqrt(x)) / std::sqrt(x), 4e-16) << x;
  }
}

TEST(TanhRatio, IsSmoothWhereTheSeriesEnds) {
  EXPECT_NEAR(tanh_ratio(0.05 - 1e-16), tanh_ratio(0.05), 1e-14);
  EXPECT_NEAR(slope(0.05 - 1e-16), slope(0.05), 1e-14);
}

TEST(TanhRatio, ItsLanesAreDerivatives) {
  for (double x : {0.0, 1e-6, 0.03, 0.0499, 0.0501, 0.7, 16.0, 1600.0}) {
    Lanes<4> lane(x);
    lane.v[2] = 1.0;
    EXPECT_NEAR(tanh_ratio(lane).v[2], slope(x), 1e-14) << x;
  }
}

using L = Lanes<4>;
using C = std::complex<double>;

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
