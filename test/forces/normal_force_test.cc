// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "forces/normal_force.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace codesign {
namespace {

template <class T>
FrictionConstants<T> geometry() {
  FrictionConstants<T> c;
  c.joint_length = T(0.05);
  c.joint_width = T(0.025);
  c.pin_radius = T(0.01);
  c.friction_arm = T(0.015);
  c.preload = T(2.0);
  c.smoothing = T(0.01);
  return c;
}

const Eigen::Vector3d kF(3.0, -20.0, 5.0), kTorque(0.02, -0.4, 0.03);

TEST(NormalForce, TranslationalByHand) {
  // f1 = (-3 - 8, 20 - 0.4), f2 = (8, 0.4), f3 = 0.6.
  auto cabs = [](double x) { return std::hypot(x, 0.01); };
  const double expected = cabs(-11.0) + cabs(19.6) + cabs(8.0) + cabs(0.4) + 2.0 * cabs(0.6) + 2.0;
  EXPECT_NEAR(translational_normal_force<double>(kF, kTorque, geometry<double>()), expected, 1e-12);
}

TEST(NormalForce, PinAndRevoluteByHand) {
  const double parabolic = std::pow(M_PI, 3) / 24.0;
  const double pin =
      parabolic * (std::sqrt(11.0 * 11.0 + 19.6 * 19.6 + 1e-4) + std::sqrt(64.0 + 0.16 + 1e-4)) +
      2.0;
  EXPECT_NEAR(pin_normal_force<double>(kF, kTorque, geometry<double>()), pin, 1e-12);
  EXPECT_NEAR(revolute_normal_force<double>(kF, kTorque, geometry<double>()),
              pin + 1.5 * std::hypot(5.0, 0.01), 1e-12);
}

TEST(NormalForce, PinDoesNotSeeATurnAboutItsAxis) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Vector3d F = R * kF, torque = R * kTorque;
  EXPECT_NEAR(pin_normal_force<double>(F, torque, geometry<double>()),
              pin_normal_force<double>(kF, kTorque, geometry<double>()), 1e-12);
}

TEST(NormalForce, PlanarAndBallByHand) {
  EXPECT_NEAR(planar_normal_force<double>(kF, Eigen::Vector3d::Zero(), geometry<double>()),
              std::hypot(5.0, 0.01) + 2.0, 1e-12);
  EXPECT_EQ(planar_normal_force<double>(-kF, Eigen::Vector3d::Zero(), geometry<double>()),
            planar_normal_force<double>(kF, Eigen::Vector3d::Zero(), geometry<double>()));
  EXPECT_NEAR(ball_normal_force<double>(kF, Eigen::Vector3d::Zero(), geometry<double>()),
              std::sqrt(9.0 + 400.0 + 25.0 + 1e-4) + 2.0, 1e-12);
  EXPECT_NEAR(ball_normal_force<double>(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                        geometry<double>()),
              0.01 + 2.0, 1e-15);
}

}  // namespace
}  // namespace codesign
