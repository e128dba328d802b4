// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/directional_friction.h"

#include <gtest/gtest.h>

#include <complex>

#include "forces/brown_mcphee.h"

namespace codesign {
namespace {

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
  return directional_friction<T>(
      [](const T& at, const T& mu_s, const T& mu_d, const T& v_t) { return brown_mcphee<T>(at, mu_s, mu_d, v_t); }, v, c);
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
  EXPECT_NEAR(directional_brown_mcphee(0.01, c), w * (0.3 * th + 0.1) + (1.0 - w) * (0.1 * th + 0.15), 1e-15);
  EXPECT_EQ(directional_brown_mcphee(0.0, c), 0.0);
  // At rest: the mean of both slopes, (4 mu_d + 16/9 (mu_s - mu_d)) / v_t.
  EXPECT_NEAR(directional_brown_mcphee(Complex(0.0, 1e-30), directional_numbers<Complex>()).imag() / 1e-30,
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

}  // namespace
}  // namespace codesign
