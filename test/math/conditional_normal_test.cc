// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "math/conditional_normal.h"

#include <gtest/gtest.h>

#include "math/dense.h"

namespace codesign {
namespace {

/// The covariance that the conditional distributions make together: x - m = slopes (x - m) + e.
Eigen::MatrixXd composed(const ConditionalNormal& normal) {
  const Eigen::Index size = normal.slopes.rows();
  const Eigen::MatrixXd root = least_norm(Eigen::MatrixXd::Identity(size, size) - normal.slopes)
                                   .solve(normal.deviations.asDiagonal());
  return product(root, root.transpose());
}

TEST(ConditionalNormal, OfTwoNumbersByHand) {
  // deviations 2 and 3, correlation 0.6: the slope is 0.6 * 3 / 2, the remaining deviation of the
  // second is 3 sqrt(1 - 0.36).
  const auto normal = conditional_normal((Eigen::Matrix2d() << 4.0, 3.6, 3.6, 9.0).finished());
  ASSERT_TRUE(normal);
  EXPECT_DOUBLE_EQ(normal->slopes(1, 0), 0.9);
  EXPECT_DOUBLE_EQ(normal->deviations[0], 2.0);
  EXPECT_DOUBLE_EQ(normal->deviations[1], 2.4);
  EXPECT_EQ(normal->slopes(0, 1), 0.0);
}

TEST(ConditionalNormal, ComposesToTheCovariance) {
  Eigen::Matrix4d root;
  root << 1, 0, 0, 0, 0.5, 2, 0, 0, -1, 0.3, 1e-3, 0, 4, 1, 2, 50;
  const Eigen::MatrixXd covariance = root * root.transpose();
  const auto normal = conditional_normal(covariance);
  ASSERT_TRUE(normal);
  EXPECT_TRUE(composed(*normal).isApprox(covariance, 1e-10)) << composed(*normal) << "\n"
                                                             << covariance;
}

TEST(ConditionalNormal, ANumberThatIsKnownOrFollowsFromOthers) {
  Eigen::Matrix3d covariance;  // the second is known, the third is twice the first
  covariance << 1, 0, 2, 0, 0, 0, 2, 0, 4;
  const auto normal = conditional_normal(covariance);
  ASSERT_TRUE(normal);
  EXPECT_EQ(normal->deviations[1], 0.0);
  EXPECT_EQ(normal->deviations[2], 0.0);
  EXPECT_DOUBLE_EQ(normal->slopes(2, 0), 2.0);
  EXPECT_TRUE(composed(*normal).isApprox(covariance, 1e-12));
}

TEST(ConditionalNormal, RefusesWhatNoDistributionHas) {
  EXPECT_FALSE(conditional_normal((Eigen::Matrix2d() << 1.0, 2.0, 2.0, 1.0).finished()))
      << "correlation 2";
  EXPECT_FALSE(conditional_normal((Eigen::Matrix2d() << -1.0, 0.0, 0.0, 1.0).finished()));
  EXPECT_FALSE(conditional_normal((Eigen::Matrix2d() << 0.0, 1.0, 1.0, 1.0).finished()))
      << "a known number correlates with nothing";
}

}  // namespace
}  // namespace codesign
