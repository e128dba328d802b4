// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/gear.h"

#include <gtest/gtest.h>
#include <cmath>
#include <complex>

#include "math/differences.h"

namespace codesign {
namespace {

/// A gear with efficiency 0.8, and 0.6 where the joint drives the motor.
template <class T>
GearConstants<T> gear() {
  GearConstants<T> c;
  c.driving = T(1.0 / 0.8 - 1.0);
  c.backdriving = T(1.0 - 0.6);
  c.slip.smoothing = T(1e-6);
  return c;
}

TEST(GearLoss, ByDirectionOfPower) {
  const GearConstants<double> c = gear<double>();
  // Of 10 N m at the joint, the motor gives 12.5 N m to drive and takes 6 N m back.
  EXPECT_NEAR(10.0 + gear_loss(10.0, 1.0, c), 12.5, 1e-12);
  EXPECT_NEAR(-10.0 + gear_loss(-10.0, -1.0, c), -12.5, 1e-12);
  EXPECT_NEAR(10.0 + gear_loss(10.0, -1.0, c), 6.0, 1e-12);
  EXPECT_NEAR(-10.0 + gear_loss(-10.0, 1.0, c), -6.0, 1e-12);
}

TEST(GearLoss, ByHandWithinTheTransitionAndWithoutTorque) {
  GearConstants<double> c = gear<double>();
  // mean 0.325, more -0.075, at mu = 0.5.
  EXPECT_NEAR(gear_loss(10.0, 0.5, c), 0.5 * (3.25 - 0.375), 1e-12);
  EXPECT_NEAR(gear_loss(10.0, -0.5, c), -0.5 * (3.25 + 0.375), 1e-12);
  EXPECT_EQ(gear_loss(10.0, 0.0, c), 0.0);
  c.slip.smoothing = 0.01;
  EXPECT_NEAR(gear_loss(0.0, 1.0, c), 0.325 * 0.01, 1e-16);
}

TEST(GearLoss, NeverDrives) {
  GearConstants<double> c = gear<double>();
  c.backdriving = 1.3;  // self-locking
  c.slip.smoothing = 0.1;
  for (double tau = -3.0; tau <= 3.0; tau += 0.05)
    for (double mu = -1.0; mu <= 1.0; mu += 0.125)
      EXPECT_GE(mu * gear_loss(tau, mu, c), 0.0) << tau << " " << mu;
}

TEST(GearLoss, ASelfLockingGearHoldsAnyLoad) {
  GearConstants<double> c = gear<double>();
  c.backdriving = 1.3;
  // 1 - m mean + m^2 more = 0 with mean 0.775, more -0.525, at mu = -m.
  const double mean = 0.775, more = -0.525,
               held = (-mean + std::sqrt(mean * mean - 4.0 * more)) / (-2.0 * more);
  ASSERT_LT(held, 1.0);
  for (double load : {1.0, 50.0, 2000.0})
    EXPECT_NEAR(load + gear_loss(load, -held, c), 0.0, 1e-11 * load);
}

TEST(GearLoss, IsAnalytic) {
  using C = std::complex<double>;
  const auto law = [](const Eigen::VectorXcd& x) {
    return Eigen::VectorXcd(Eigen::VectorXcd::Constant(1, gear_loss(x[0], x[1], gear<C>())));
  };
  const auto real = [](const Eigen::VectorXd& x) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(1, gear_loss(x[0], x[1], gear<double>())));
  };
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(2.0, 0.7), Eigen::Vector2d(-1.5, 0.7),
                                   Eigen::Vector2d(1.2, -0.3), Eigen::Vector2d(-4.0, 0.0)}) {
    const Eigen::MatrixXd exact = complex_step_jacobian(law, x);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d step = 1e-6 * Eigen::Vector2d::Unit(k);
      EXPECT_NEAR(exact(0, k), (real(x + step) - real(x - step))[0] / 2e-6, 1e-8);
    }
  }
}

}  // namespace
}  // namespace codesign
