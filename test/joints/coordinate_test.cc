// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/coordinate.h"

#include <gtest/gtest.h>

#include "joints/two_bodies.h"
#include "math/differences.h"

namespace codesign {
namespace {

using Kind = CoordinateConstants<double>::Kind;

template <class T>
PairConstants<T> pair() {
  PairConstants<T> c;
  c.s_i = Vector3<T>(T(0.1), T(-0.2), T(0.3));
  c.s_j = Vector3<T>(T(-0.3), T(0.1), T(0.2));
  return c;
}

template <class T>
CoordinateConstants<T> coordinate(Kind kind, bool fixed_in_j) {
  CoordinateConstants<T> c;
  c.kind = static_cast<typename CoordinateConstants<T>::Kind>(kind);
  c.sign = -1.0;
  c.fixed_in_j = fixed_in_j;
  c.a = Vector3<T>(T(0.6), T(0.0), T(0.8));
  c.b = Vector3<T>(T(0.0), T(1.0), T(0.0));
  c.c = Vector3<T>(T(0.0), T(0.6), T(0.8));
  c.d = Vector3<T>(T(0.8), T(-0.6), T(0.0));
  return c;
}

template <class T>
CoordinateMotion<T> motion(Kind kind, bool fixed_in_j, const VectorX<T>& q, const VectorX<T>& v,
                           const VectorX<T>& a) {
  return coordinate_motion(pair<T>(), coordinate<T>(kind, fixed_in_j), local_body(q, v, a, 0),
                           local_body(q, v, a, kBodySize));
}

/// J against the complex step of the rate by v; rate and acceleration against the time derivatives
/// of position and rate.
void expect_exact(Kind kind, bool fixed_in_j = false) {
  using C = std::complex<double>;
  constexpr double h = 1e-30;
  const Eigen::VectorXd q = generic_local(0.2), v = generic_local(1.3), a = generic_local(2.1);
  const CoordinateMotion<double> m = motion<double>(kind, fixed_in_j, q, v, a);
  const auto rate = [&](const Eigen::VectorXcd& z) {
    return Eigen::VectorXcd::Constant(
        1, motion<C>(kind, fixed_in_j, q.cast<C>(), z, a.cast<C>()).rate);
  };
  EXPECT_LT(compare_jacobians(m.J.transpose(), complex_step_jacobian(rate, v)).largest, 1e-13);
  const CoordinateMotion<C> along = motion<C>(kind, fixed_in_j, q.cast<C>() + C(0, h) * v.cast<C>(),
                                              v.cast<C>() + C(0, h) * a.cast<C>(), a.cast<C>());
  const bool is_function_of_q = kind == Kind::kSlide || kind == Kind::kAngle || kind == Kind::kSine;
  EXPECT_NEAR(is_function_of_q ? along.position.imag() / h : m.rate, m.rate, 1e-13);
  EXPECT_NEAR(along.rate.imag() / h, m.acceleration, 1e-13 * (1.0 + std::abs(m.acceleration)));
}

TEST(Coordinate, RatesOfEveryKindAreExact) {
  expect_exact(Kind::kSlide);
  expect_exact(Kind::kSlide, true);
  expect_exact(Kind::kAngle);
  expect_exact(Kind::kSine);
  expect_exact(Kind::kTurn);
  expect_exact(Kind::kSpin);
}

TEST(Coordinate, TurnReadsAnAngleAndItsRate) {
  VectorX<double> q = VectorX<double>::Zero(kLocalSize), v = q, a = q;
  q[3] = 1.0;
  q[kBodySize + 3] = std::cos(0.35);
  q[kBodySize + 6] = std::sin(0.35);
  // omega = 2 about z: p' = E^T omega / 2.
  v.segment<4>(kBodySize + 3) =
      0.5 * ground_rate_matrix<double>(q.segment<4>(kBodySize + 3)).transpose() *
      Vector3<double>(0.0, 0.0, 2.0);
  CoordinateConstants<double> c;
  c.kind = Kind::kTurn;
  const CoordinateMotion<double> m = coordinate_motion(
      PairConstants<double>(), c, local_body(q, v, a, 0), local_body(q, v, a, kBodySize));
  EXPECT_NEAR(m.position, 0.7, 1e-15);
  EXPECT_NEAR(m.rate, 2.0, 1e-15);
}

TEST(Coordinate, SpinIsAComponentOfTheRelativeAngularVelocity) {
  VectorX<double> q = generic_local(0.2), v = VectorX<double>::Zero(kLocalSize);
  const Eigen::Vector3d omega_i(0.3, -1.0, 0.7), omega_j(2.0, 0.5, -0.4);
  for (int first : {3, kBodySize + 3}) q.segment<4>(first).normalize();
  v.segment<4>(3) = 0.5 * ground_rate_matrix<double>(q.segment<4>(3)).transpose() * omega_i;
  v.segment<4>(kBodySize + 3) =
      0.5 * ground_rate_matrix<double>(q.segment<4>(kBodySize + 3)).transpose() * omega_j;
  CoordinateConstants<double> c;
  c.kind = Kind::kSpin;
  c.a = Eigen::Vector3d(0.6, 0.0, 0.8);
  const CoordinateMotion<double> m = coordinate_motion(
      PairConstants<double>(), c, local_body(q, v, v, 0), local_body(q, v, v, kBodySize));
  EXPECT_NEAR(m.rate, c.a.dot(omega_j - omega_i), 1e-14);
}

}  // namespace
}  // namespace codesign
