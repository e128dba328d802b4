// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "joints/body_kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

using MovingBody = BodyKinematics<double>;

/// A body that moves and turns smoothly, at time t, with derivatives written by hand.
MovingBody on_a_path(double t) {
  MovingBody b;
  b.r = {std::sin(t), t * t, 1.0};
  b.rd = {std::cos(t), 2.0 * t, 0.0};
  b.rdd = {-std::sin(t), 2.0, 0.0};
  // A turn about z by the angle t^2: half of it is u.
  const double u = 0.5 * t * t, ud = t, udd = 1.0;
  b.p = {std::cos(u), 0.0, 0.0, std::sin(u)};
  b.pd = {-std::sin(u) * ud, 0.0, 0.0, std::cos(u) * ud};
  b.pdd = {-std::cos(u) * ud * ud - std::sin(u) * udd, 0.0, 0.0,
           -std::sin(u) * ud * ud + std::cos(u) * udd};
  b.update_rotation();
  return b;
}

TEST(BodyKinematics, TheGroundRests) {
  MovingBody ground;
  ground.update_rotation();
  EXPECT_EQ(ground.A, Eigen::Matrix3d::Identity());
  EXPECT_EQ(ground.Ad, Eigen::Matrix3d::Zero());
  EXPECT_EQ(ground.Add, Eigen::Matrix3d::Zero());
}

TEST(BodyKinematics, ATurnAboutZAndItsDerivatives) {
  const double t = 1.2, angle = t * t, rate = 2.0 * t, acceleration = 2.0;
  const VectorMotion<double> x =
      direction_motion(on_a_path(t), Vector3<double>(Vector3<double>::UnitX()));
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0),
      across(-std::sin(angle), std::cos(angle), 0.0);
  EXPECT_LT((x.x - along).norm(), 1e-15);
  EXPECT_LT((x.xd - rate * across).norm(), 1e-14);
  EXPECT_LT((x.xdd - (acceleration * across - rate * rate * along)).norm(), 1e-13);
}

TEST(BodyKinematics, DisplacementRunsFromIToJ) {
  const MovingBody i = on_a_path(0.7), j = on_a_path(1.1);
  const Vector3<double> s_i(0.1, 0.2, 0.3), s_j(-0.4, 0.5, 0.6);
  const VectorMotion<double> d = displacement_motion(i, s_i, j, s_j);
  const VectorMotion<double> a_i = direction_motion(i, s_i), a_j = direction_motion(j, s_j);
  EXPECT_LT((d.x - (j.r + a_j.x - i.r - a_i.x)).norm(), 1e-15);
  EXPECT_LT((d.xd - (j.rd + a_j.xd - i.rd - a_i.xd)).norm(), 1e-15);
  EXPECT_LT((d.xdd - (j.rdd + a_j.xdd - i.rdd - a_i.xdd)).norm(), 1e-14);
  EXPECT_NEAR(displacement_motion(i, s_i, i, s_i).x.norm(), 0.0, 1e-15);
}

}  // namespace
}  // namespace codesign
