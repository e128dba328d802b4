// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <complex>

#include "forces/compliance.h"

namespace codesign {
namespace {

constexpr double kStiffness = 2000.0, kDissipation = 0.5, kWidth = 0.01;

double stop(double excess, double rate) {
  return joint_stop(excess, rate, kStiffness, kDissipation, kWidth);
}

/// dF/dg at rest, by the complex step.
double slope(double excess) {
  using C = std::complex<double>;
  return joint_stop<C>(C(excess, 1e-30), C(0.0), kStiffness, kDissipation, kWidth).imag() / 1e-30;
}

TEST(JointStop, ByHand) {
  // Half way into the width: s = 1/2, depth = w (5/32 - 3/32 + 1/64) = 5 w/64, slope = 1/2.
  EXPECT_NEAR(stop(0.005, 0.0), 2000.0 * 0.01 * 5.0 / 64.0, 1e-13);
  EXPECT_NEAR(slope(0.005), 1000.0, 1e-10);
  EXPECT_NEAR(stop(0.03, 0.0), 2000.0 * 0.025, 1e-12);
  // 0.75/0.5 m/s: y = 0.75, h = 0.75 + 1.25 = 2 going in, 1/2 coming out.
  EXPECT_NEAR(stop(0.03, 1.5), 100.0, 1e-12);
  EXPECT_NEAR(stop(0.03, -1.5), 25.0, 1e-12);
}

TEST(JointStop, WithinTheLimitsThereIsNothing) {
  for (double excess : {0.0, -1e-9, -1.0}) EXPECT_EQ(stop(excess, 3.0), 0.0);
}

TEST(JointStop, NeverPulls) {
  for (double excess : {1e-9, 1e-3, 0.01, 0.2})
    for (double rate : {-1e9, -50.0, -1.0, 0.0, 1.0})
      EXPECT_GT(stop(excess, rate), 0.0) << excess << ' ' << rate;
}

TEST(JointStop, MeetsSmoothlyAtBothEndsOfItsWidth) {
  // The second derivative is continuous: near each end the slope differs from the end's by the cube
  // of the distance.
  EXPECT_LT(slope(1e-3 * kWidth), 1.01e-8 * kStiffness);
  EXPECT_NEAR(slope(kWidth * (1.0 - 1e-3)), kStiffness, 1.01e-8 * kStiffness);
  EXPECT_NEAR(stop(std::nextafter(kWidth, 0.0), 0.0), stop(kWidth, 0.0), 1e-12);
}

TEST(JointStop, EnergyIsTheIntegralOfTheForce) {
  using C = std::complex<double>;
  for (double excess : {-0.1, 0.003, 0.01, 0.04})
    EXPECT_NEAR(stop_energy<C>(C(excess, 1e-30), kStiffness, kWidth).imag() / 1e-30,
                stop(excess, 0.0), 1e-11)
        << excess;
  EXPECT_EQ(stop_energy(0.0, kStiffness, kWidth), 0.0);
}

constexpr double kSpringStiffness = 1000.0, kSpringDamping = 50.0, kSpringFree = 0.1;

TEST(SpringDamper, ByHand) {
  // Length 0.5 m, 0.4 m above the free length; its rate is 0.6 * 0.1 - 0.8 * 0.2 = -0.1 m/s.
  const auto s = spring_damper<double>({0.3, 0.0, -0.4}, {0.1, 5.0, 0.2}, kSpringStiffness,
                                       kSpringDamping, kSpringFree);
  EXPECT_NEAR(s.length, 0.5, 1e-15);
  EXPECT_NEAR(s.tension, 400.0 - 5.0, 1e-11);
  EXPECT_NEAR((s.pull - 395.0 * Eigen::Vector3d(0.6, 0.0, -0.8)).norm(), 0.0, 1e-11);
  EXPECT_NEAR(spring_energy<double>({0.3, 0.0, -0.4}, kSpringStiffness, kSpringFree),
              0.5 * 1000.0 * 0.16, 1e-12);
}

TEST(SpringDamper, PointsThatMeetFeelNothing) {
  const auto s = spring_damper<double>(Eigen::Vector3d::Zero(), {0.1, 5.0, 0.2}, kSpringStiffness,
                                       kSpringDamping, kSpringFree);
  EXPECT_EQ(s.pull.norm(), 0.0);
  // Without a free length the spring is linear through zero: pull = k d.
  const Eigen::Vector3d d(1e-12, -3e-10, 2e-9);
  const auto zero_length =
      spring_damper<double>(d, Eigen::Vector3d::Zero(), kSpringStiffness, 0.0, 0.0);
  EXPECT_NEAR((zero_length.pull - kSpringStiffness * d).norm(), 0.0, 1e-18);
}

}  // namespace

}  // namespace codesign
