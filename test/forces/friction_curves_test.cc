// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <complex>

#include "forces/friction_curves.h"
#include "math/differences.h"

namespace codesign {
namespace {

constexpr double kMuS = 0.4, kMuD = 0.3, kVt = 0.01;

TEST(BrownMcPhee, HandComputedPoints) {
  // At v = v_t: d = 1, S = mu_d tanh 4 + (mu_s - mu_d).
  EXPECT_NEAR(brown_mcphee(kVt, kMuS, kMuD, kVt), kMuD * std::tanh(4.0) + 0.1, 1e-16);
  // At v = 2 v_t: d = 7/4, S = mu_d tanh 8 + 0.1 * 2 * 16/49.
  EXPECT_NEAR(brown_mcphee(2.0 * kVt, kMuS, kMuD, kVt),
              kMuD * std::tanh(8.0) + 0.1 * 2.0 * 16.0 / 49.0, 1e-15);
  // At rest S = 0 and S' = (4 mu_d + 16/9 (mu_s - mu_d)) / v_t.
  EXPECT_EQ(brown_mcphee(0.0, kMuS, kMuD, kVt), 0.0);
  using C = std::complex<double>;
  EXPECT_NEAR(brown_mcphee(C(0.0, 1e-30), C(kMuS), C(kMuD), C(kVt)).imag() / 1e-30,
              (4.0 * kMuD + 16.0 / 9.0 * 0.1) / kVt, 1e-12);
}

TEST(BrownMcPhee, IsOddAndSettlesAtTheDynamicCoefficient) {
  EXPECT_EQ(brown_mcphee(-0.003, kMuS, kMuD, kVt), -brown_mcphee(0.003, kMuS, kMuD, kVt));
  EXPECT_NEAR(brown_mcphee(10.0, kMuS, kMuD, kVt), kMuD, 1e-8);
}

using Complex = std::complex<double>;

template <class T>
FrictionNumbers<T> directional_numbers() {
  FrictionNumbers<T> c;
  c.mu_static = T(0.4);
  c.mu_dynamic = T(0.3);
  c.mu_static_backward = T(0.25);
  c.mu_dynamic_backward = T(0.1);
  c.transition_velocity = T(0.01);
  c.viscous = T(2.0);
  c.viscous_backward = T(0.5);
  return c;
}

template <class T>
T directional_brown_mcphee(const T& v, const FrictionNumbers<T>& c) {
  const auto S = [&c](const T& at, const T& mu_s, const T& mu_d) {
    return brown_mcphee<T>(at, mu_s, mu_d, c.transition_velocity);
  };
  return directional_friction<T>(S, v, c);
}

TEST(DirectionalFriction, TheShareChangesOverAtRest) {
  EXPECT_EQ(forward_share(0.0, 0.01), 0.5);
  EXPECT_NEAR(forward_share(Complex(0.0, 1e-30), Complex(0.01)).imag() / 1e-30, 200.0, 1e-12);
  EXPECT_NEAR(forward_share(0.01, 0.01), 0.5 * (1.0 + std::tanh(4.0)), 1e-16);
  EXPECT_EQ(forward_share(1.0, 0.01), 1.0);
  EXPECT_EQ(forward_share(-1.0, 0.01), 0.0);
}

TEST(DirectionalFriction, FarFromRestEachDirectionHasItsOwnNumbers) {
  const FrictionNumbers<double> c = directional_numbers<double>();
  for (double v : {0.1, 0.5, 3.0}) {
    EXPECT_EQ(directional_brown_mcphee(v, c), brown_mcphee(v, 0.4, 0.3, 0.01));
    EXPECT_EQ(directional_brown_mcphee(-v, c), brown_mcphee(-v, 0.25, 0.1, 0.01));
    EXPECT_EQ(directional_viscous(v, 1.0, c), 2.0 * v);
    EXPECT_EQ(directional_viscous(-v, 1.0, c), -0.5 * v);
  }
}

TEST(DirectionalFriction, ByHandWithinTheTransition) {
  const FrictionNumbers<double> c = directional_numbers<double>();
  const double w = 0.5 * (1.0 + std::tanh(4.0)), th = std::tanh(4.0);
  EXPECT_NEAR(directional_brown_mcphee(0.01, c),
              w * (0.3 * th + 0.1) + (1.0 - w) * (0.1 * th + 0.15), 1e-15);
  EXPECT_EQ(directional_brown_mcphee(0.0, c), 0.0);
  // At rest: the mean of both slopes, (4 mu_d + 16/9 (mu_s - mu_d)) / v_t.
  EXPECT_NEAR(
      directional_brown_mcphee(Complex(0.0, 1e-30), directional_numbers<Complex>()).imag() / 1e-30,
      0.5 * (4.0 * 0.4 + 16.0 / 9.0 * 0.25) / 0.01, 1e-12);
  // A turn on a radius of 2 cm slides at 0.01 m/s.
  EXPECT_NEAR(directional_viscous(0.5, 0.02, c), 0.5 * (0.5 + 1.5 * w), 1e-15);
}

TEST(DirectionalFriction, EqualNumbersAreTheLawWithoutDirection) {
  FrictionNumbers<double> c = directional_numbers<double>();
  c.mu_static_backward = c.mu_static;
  c.mu_dynamic_backward = c.mu_dynamic;
  c.viscous_backward = c.viscous;
  for (double v : {-0.3, -0.004, 0.0, 0.007, 0.1}) {
    EXPECT_EQ(directional_brown_mcphee(v, c), brown_mcphee(v, 0.4, 0.3, 0.01));
    EXPECT_EQ(directional_viscous(v, 0.02, c), 2.0 * v);
  }
}

TEST(DirectionalFriction, NeverDrivesTheMotion) {
  const FrictionNumbers<double> c = directional_numbers<double>();
  for (double v = -0.05; v <= 0.05; v += 1e-4) {
    EXPECT_GE(directional_brown_mcphee(v, c) * v, 0.0) << v;
    EXPECT_GE(directional_viscous(v, 1.0, c) * v, 0.0) << v;
  }
}

/// Coulomb 5, static 7 N m, 0.2 rad/s.
template <class T>
FrictionNumbers<T> stribeck_numbers() {
  FrictionNumbers<T> c;
  c.mu_static = T(7.0);
  c.mu_dynamic = T(5.0);
  c.stribeck_velocity = T(0.2);
  c.transition_velocity = T(0.01);
  return c;
}

TEST(Stribeck, HandComputedPoints) {
  const FrictionNumbers<double> c = stribeck_numbers<double>();
  const auto S = [&c](double v) { return stribeck(v, c.mu_static, c.mu_dynamic, c); };
  EXPECT_EQ(S(0.0), 0.0);
  EXPECT_NEAR(S(0.01), (5.0 + 2.0 * std::exp(-0.0025)) * std::tanh(4.0), 1e-14);
  EXPECT_NEAR(S(0.2), 5.0 + 2.0 * std::exp(-1.0), 1e-14);
  EXPECT_NEAR(S(-0.2), -S(0.2), 0.0);
  EXPECT_NEAR(S(3.0), 5.0, 1e-15);
  // At rest the slope is 4 T_s / v_t.
  const FrictionNumbers<Complex> z = stribeck_numbers<Complex>();
  EXPECT_NEAR(stribeck(Complex(0.0, 1e-30), z.mu_static, z.mu_dynamic, z).imag() / 1e-30, 2800.0,
              1e-9);
}

TEST(ViscousPower, IsTheGivenPowerAwayFromRestAndSmoothThere) {
  for (double rate : {0.5, -2.0})
    EXPECT_NEAR(3.0 * rate * viscous_power(rate, 1e-6, 0.6),
                3.0 * std::copysign(std::pow(std::abs(rate), 0.6), rate), 1e-10);
  EXPECT_EQ(viscous_power(0.3, 0.01, 1.0), 1.0);
  EXPECT_NEAR(viscous_power(0.0, 0.01, 0.5), 10.0, 1e-13);
  EXPECT_NEAR(viscous_power(0.03, 0.04, 3.0), 0.0025, 1e-17);
}

TEST(ViscousPower, HasItsDerivatives) {
  const auto law = [](const Eigen::VectorXcd& x) {
    return Eigen::VectorXcd(Eigen::VectorXcd::Constant(1, x[0] * viscous_power(x[0], x[1], x[2])));
  };
  // c (r^2 + w^2)^b r with b = (a - 1)/2: by r: f/r + 2 b r f/(r^2 + w^2), by a: f ln(...)/2.
  const Eigen::Vector3d x(0.02, 0.01, 0.6);
  const double square = 0.0005, f = 0.02 * std::pow(square, -0.2);
  const Eigen::MatrixXd exact = complex_step_jacobian(law, x);
  EXPECT_NEAR(exact(0, 0), f / 0.02 - 0.4 * 0.02 * f / square, 1e-12);
  EXPECT_NEAR(exact(0, 1), -0.4 * 0.01 * f / square, 1e-12);
  EXPECT_NEAR(exact(0, 2), 0.5 * f * std::log(square), 1e-13);
}

constexpr double kIsotropicMuS = 0.4, kIsotropicMuD = 0.3, kIsotropicVt = 0.01;

/// S(|u|)/|u| as a function of u.u.
template <class T>
T per_speed(const T& square) {
  return friction_per_speed<T>(square, T(kIsotropicMuS), T(kIsotropicMuD), T(kIsotropicVt));
}

/// The derivative of the load at N = 7 by the slip, by the complex step.
Eigen::MatrixXd expected_slope(const Eigen::Vector3d& u) {
  using C = std::complex<double>;
  const auto law = [](const Eigen::VectorXcd& z) {
    return Eigen::VectorXcd(isotropic_friction<C, 3>(z.head<3>(), C(7.0), per_speed<C>));
  };
  return complex_step_jacobian(law, u);
}

TEST(IsotropicFriction, IsTheScalarLawAlongTheSlip) {
  for (double s : {1e-5, 0.0007, 0.0009, 0.01, 0.02, 0.5}) {
    const double S = brown_mcphee(s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt);
    EXPECT_NEAR(friction_per_speed(s * s, kIsotropicMuS, kIsotropicMuD, kIsotropicVt) * s, S, 1e-15)
        << s;
    const Eigen::Vector2d u(0.6 * s, -0.8 * s);
    const auto f = isotropic_friction<double, 2>(u, 7.0, per_speed<double>);
    EXPECT_NEAR((f - 7.0 * S * Eigen::Vector2d(0.6, -0.8)).norm(), 0.0, 1e-13) << s;
  }
}

TEST(IsotropicFriction, AtRestItIsLinear) {
  const auto f = isotropic_friction<double, 3>(Eigen::Vector3d::Zero(), 7.0, per_speed<double>);
  EXPECT_EQ(f.norm(), 0.0);
  // S'(0) = (4 mu_d + 16/9 (mu_s - mu_d))/v_t in every direction.
  const Eigen::Matrix3d by_slip = expected_slope(Eigen::Vector3d::Zero());
  EXPECT_NEAR((by_slip - 7.0 * (4.0 * kIsotropicMuD + 16.0 / 9.0 * 0.1) / kIsotropicVt *
                             Eigen::Matrix3d::Identity())
                  .norm(),
              0.0, 1e-11);
}

TEST(IsotropicFriction, LanesCarryTheDerivatives) {
  using L = Lanes<4>;
  for (double s : {0.0, 1e-4, 0.00079, 0.0008, 0.012, 0.3}) {
    const Eigen::Vector3d at(0.36 * s, -0.48 * s, 0.8 * s);
    Eigen::Matrix<L, 3, 1> u = at.cast<L>();
    for (int k = 0; k < 3; ++k) u[k].v[k] = 1.0;
    const auto lanes = isotropic_friction<L, 3>(u, L(7.0), per_speed<L>);
    Eigen::Matrix3d by_slip;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) by_slip(row, column) = lanes[row].v[column];
    EXPECT_LT(compare_jacobians(by_slip, expected_slope(at)).largest, 1e-13) << s;
  }
}

TEST(IsotropicFriction, LengthHasNoSlopeAtRest) {
  Eigen::Matrix<Lanes<4>, 2, 1> u(Lanes<4>(0.0), Lanes<4>(0.0));
  u[0].v[0] = 1.0;
  EXPECT_EQ((length_of<Lanes<4>, 2>(u).v[0]), 0.0);
  u[0].a = 0.3;
  u[1].a = 0.4;
  EXPECT_NEAR((length_of<Lanes<4>, 2>(u).a), 0.5, 1e-16);
  EXPECT_NEAR((length_of<Lanes<4>, 2>(u).v[0]), 0.6, 1e-15);
}

}  // namespace

}  // namespace codesign
