// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/chain_geometry.h"

#include <gtest/gtest.h>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// ground - yaw (z, at height 1) - massless fork - pitch (y, 0.5 further up, turned about z by a right angle) - arm.
const RobotDescription& robot() {
  static const RobotDescription robot = read_urdf(robot_text(
      kGround + link_with("fork", "") + link_with("arm") +
      joint_with("yaw", "continuous", "ground", "fork", "<origin xyz='0 0 1'/><axis xyz='0 0 1'/>") +
      joint_with("pitch", "continuous", "fork", "arm", "<origin xyz='0 0 0.5' rpy='0 0 1.5707963267948966'/><axis xyz='0 2 0'/>")));
  return robot;
}

ChainGeometry<double> geometry(const std::vector<ChainElement>& chain) {
  return chain_geometry<double>(robot(), derive_topology(robot()), chain, {0.2});
}

TEST(ChainGeometry, FramesAndAxesAreSeenFromBodyI) {
  const ChainGeometry<double> g = geometry({{0, false}, {1, false}});
  EXPECT_LT((g.frames[0].t - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 1e-15);
  EXPECT_LT((g.frames[1].t - Eigen::Vector3d(0.0, 0.0, 1.5)).norm(), 1e-15);
  EXPECT_LT((g.axes[0] - Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((g.axes[1] - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-15) << "the unit of y, turned about z";
  EXPECT_LT((g.X_ij.t - Eigen::Vector3d(0.0, 0.0, 1.5)).norm(), 1e-15);
}

TEST(ChainGeometry, WalkedBackwardsItIsTheInverse) {
  const Pose<double> there = geometry({{0, false}, {1, false}}).X_ij, back = geometry({{1, true}, {0, true}}).X_ij;
  const Pose<double> round = there * back;
  EXPECT_LT((round.R - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT(round.t.norm(), 1e-15);
}

TEST(NearestPoint, IsWhereLinesMeetOrComeClosest) {
  using V = Vector3<double>;
  // The line along x at y = 2 and the line along y at x = 3 intersect; with the second one at z = 1 they do not.
  for (double lift : {0.0, 1.0})
    EXPECT_LT((nearest_point<double>(V(-5, 2, 0), V::UnitX(), V(3, 7, lift), V::UnitY()) - V(3, 2, 0)).norm(), 1e-14);
  const V oblique = V(1, 1, 0).normalized();
  EXPECT_LT((nearest_point<double>(V(0, 0, 0), V::UnitX(), V(4, 1, 0), oblique) - V(3, 0, 0)).norm(), 1e-14);
}

}  // namespace
}  // namespace codesign
