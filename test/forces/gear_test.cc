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

template <class T>
ElasticGearConstants<T> elastic(double backlash) {
  ElasticGearConstants<T> c;
  c.stiffness = T(200.0);
  c.damping = T(3.0);
  c.backlash = T(backlash);
  c.plays = backlash > 0.0;
  return c;
}

TEST(ElasticGear, IsASpringWithADamper) {
  EXPECT_NEAR(elastic_gear_torque(-0.02, 0.5, elastic<double>(0.0)), -4.0 + 1.5, 1e-14);
  EXPECT_NEAR(elastic_gear_energy(-0.02, elastic<double>(0.0)), 0.04, 1e-15);
}

// b = 0.1, w = 0.01: free up to 0.045, in full contact from 0.055 on.
TEST(ElasticGear, HasADeadZoneByHand) {
  const ElasticGearConstants<double> c = elastic<double>(0.1);
  for (double sign : {1.0, -1.0}) {
    EXPECT_EQ(elastic_gear_torque(sign * 0.0449, 2.0, c), 0.0) << "neither spring nor damper";
    EXPECT_EQ(elastic_gear_energy(sign * 0.0449, c), 0.0);
    EXPECT_NEAR(elastic_gear_torque(sign * 0.08, 2.0, c), sign * 200.0 * 0.03 + 6.0, 1e-12);
    // Half way s = 1/2: w s^4 (5/2 - 3 s + s^2) = 0.01 * 1.25/16, slope s^3 (10 - 15 s + 6 s^2) =
    // 1/2.
    EXPECT_NEAR(elastic_gear_torque(sign * 0.05, 2.0, c), sign * 200.0 * 0.01 * 1.25 / 16.0 + 3.0,
                1e-12);
    // The energy of 200 (x - 0.05) from there on, and k w^2/7 - k w^2/8 of the rounded corner.
    EXPECT_NEAR(elastic_gear_energy(sign * 0.08, c),
                100.0 * 0.03 * 0.03 + 200.0 * 1e-4 * (1.0 / 7.0 - 1.0 / 8.0), 1e-12);
  }
}

TEST(ElasticGear, TorqueIsTheSlopeOfItsEnergyAndItsDamperThatOfTheContact) {
  const ElasticGearConstants<std::complex<double>> c = elastic<std::complex<double>>(0.1);
  constexpr double kStep = 1e-30;
  for (double x = -0.07; x < 0.07; x += 0.0013) {
    const std::complex<double> at(x, kStep);
    EXPECT_NEAR(elastic_gear_energy(at, c).imag() / kStep,
                elastic_gear_torque(at, std::complex<double>(0.0), c).real(), 1e-12)
        << x;
    EXPECT_NEAR(flank_contact(at, c).imag() / kStep, flank_contact_slope(at, c).real(), 1e-12) << x;
  }
}

}  // namespace
}  // namespace codesign
