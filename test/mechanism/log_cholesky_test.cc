// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/log_cholesky.h"

#include <gtest/gtest.h>

#include <cmath>

namespace codesign {
namespace {

MassProperties<double> cuboid(double mass, const Vector3<double>& size, const Vector3<double>& centre) {
  MassProperties<double> m;
  m.mass = mass;
  m.centre = centre;
  const Vector3<double> square = size.cwiseProduct(size);
  m.inertia = (mass / 12.0 * Vector3<double>(square[1] + square[2], square[2] + square[0], square[0] + square[1])).asDiagonal();
  return m;
}

TEST(LogCholesky, OfACuboidByHand) {
  const auto numbers = log_cholesky(cuboid(2.0, {0.3, 0.2, 0.1}, {0.5, -0.4, 0.3}));
  ASSERT_TRUE(numbers);
  const double expected[] = {0.5 * std::log(2.0),
                             std::log(0.3 / std::sqrt(12.0)),
                             std::log(0.2 / std::sqrt(12.0)),
                             std::log(0.1 / std::sqrt(12.0)),
                             0.0,
                             0.0,
                             0.0,
                             0.5,
                             -0.4,
                             0.3};
  for (std::size_t k = 0; k < 10; ++k) EXPECT_NEAR((*numbers)[k], expected[k], 1e-14) << kLogCholeskyNames[k];
}

TEST(LogCholesky, TheFactorGivesTheSecondMomentsBack) {
  MassProperties<double> m = cuboid(1.5, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0});
  m.inertia = internal::turned(rotation_from_rpy<double>({0.3, -0.5, 0.8}), m.inertia);
  const auto n = log_cholesky(m);
  ASSERT_TRUE(n);
  const MassProperties<double> back = properties_of(*n);
  EXPECT_NEAR(back.mass, m.mass, 1e-15);
  EXPECT_EQ(back.centre, m.centre);
  EXPECT_LT((back.inertia - m.inertia).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(LogCholesky, PointsRodsPlatesAndImpossibleMomentsHaveNone) {
  EXPECT_FALSE(log_cholesky(cuboid(0.0, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0})));
  EXPECT_FALSE(log_cholesky(cuboid(1.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0})));
  for (int k = 0; k < 3; ++k) {
    Vector3<double> flat(0.3, 0.2, 0.1);
    flat[k] = 0.0;
    EXPECT_FALSE(log_cholesky(cuboid(1.0, flat, {0.0, 0.0, 0.0}))) << k;
  }
  MassProperties<double> impossible = cuboid(1.0, {0.3, 0.2, 0.1}, {0.0, 0.0, 0.0});
  impossible.inertia(0, 0) = 1.0;
  EXPECT_FALSE(log_cholesky(impossible));
}

}  // namespace
}  // namespace codesign
