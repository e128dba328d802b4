// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "mechanism/pair_geometry.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

using CoordinateKind = CoordinateConstants<double>::Kind;

struct ChainElement {
  const char *type, *axis;
  const char* origin = "";
};

/// The pair of a chain from the ground across massless links to an arm.
PairConstants<double> pair_of(const std::vector<ChainElement>& elements, const std::string& friction = "") {
  std::string text = kGround;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const bool last = k + 1 == elements.size();
    const std::string child = last ? "arm" : "m" + std::to_string(k);
    text += link_with(child, last ? kInertial : "") +
            joint_with("j" + std::to_string(k), elements[k].type, k == 0 ? "ground" : "m" + std::to_string(k - 1), child,
                       "<origin " + std::string(elements[k].origin) + "/><axis xyz='" + elements[k].axis +
                           "'/><limit effort='1' velocity='1'/>" + (last ? friction : ""));
  }
  const RobotDescription robot = read_urdf(robot_text(text));
  const Topology topology = derive_topology(robot);
  return pair_constants<double>(robot, topology, topology.pairs.at(0), Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 0.0, 0.5), {0.2});
}

void expect_frame(const Eigen::Matrix3d& C, const Eigen::Vector3d& x, const Eigen::Vector3d& z) {
  EXPECT_LT((C.col(0) - x).norm(), 1e-15);
  EXPECT_LT((C.col(1) - z.cross(x)).norm(), 1e-15);
  EXPECT_LT((C.col(2) - z).norm(), 1e-15);
}

const Eigen::Vector3d kUnitX = Eigen::Vector3d::UnitX(), kUnitY = Eigen::Vector3d::UnitY(), kUnitZ = Eigen::Vector3d::UnitZ();

TEST(PairGeometry, AHingeHasItsPointAndAxesOnBothBodies) {
  const PairConstants<double> c = pair_of({{"continuous", "0 0 3", "xyz='1 2 3' rpy='0 1.5707963267948966 0'"}});
  EXPECT_LT((c.s_i - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-15);
  EXPECT_LT((c.s_j - Eigen::Vector3d(0.0, 0.0, -0.5)).norm(), 1e-15) << "seen from the centre of mass";
  // The pitch by a right angle takes z to x and x to -z; x'' follows z in the joint frame: it is its x.
  expect_frame(c.C_i, -kUnitZ, kUnitX);
  expect_frame(c.C_j, kUnitX, kUnitZ);
  ASSERT_EQ(c.coordinates.size(), 1U);
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kTurn);
}

TEST(PairGeometry, FrictionMayChooseTheTransverseAxis) {
  const std::string friction =
      "<codesign:friction mu_static='0.3' mu_dynamic='0.2' joint_length='0.1' joint_width='0.05' transverse_axis='0 1 0'/>";
  expect_frame(pair_of({{"prismatic", "0 0 1"}}).C_i, kUnitX, kUnitZ);
  const PairConstants<double> c = pair_of({{"prismatic", "0 0 1"}}, friction);
  expect_frame(c.C_i, kUnitY, kUnitZ);
  EXPECT_EQ(c.friction.joint_width, 0.05);
  EXPECT_EQ(c.friction.mu_dynamic, 0.2);
}

TEST(PairGeometry, AUniversalJointKeepsTheAngleBetweenItsAxes) {
  const PairConstants<double> c = pair_of({{"continuous", "1 0 0"}, {"continuous", "0.6 0.8 0"}});
  EXPECT_NEAR(c.cosine, 0.6, 1e-15);
  EXPECT_LT((c.C_i.col(2) - kUnitX).norm(), 1e-15);
  EXPECT_LT((c.C_j.col(2) - Eigen::Vector3d(0.6, 0.8, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(c.C_i.determinant(), 1.0, 1e-15);
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kAngle);
  EXPECT_EQ(c.coordinates[1].kind, CoordinateKind::kAngle);
}

TEST(PairGeometry, SlidesAreReadByDualVectors) {
  const PairConstants<double> c = pair_of({{"prismatic", "1 0 0"}, {"prismatic", "0.6 0.8 0"}});
  // d = u0 x + u1 (0.6, 0.8, 0): the vector of each coordinate must give its own slide and be normal to the other's axis.
  const Eigen::Vector3d d = 0.3 * kUnitX + 0.7 * Eigen::Vector3d(0.6, 0.8, 0.0);
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kSlide);
  EXPECT_NEAR(c.coordinates[0].a.dot(d), 0.3, 1e-15);
  EXPECT_NEAR(c.coordinates[1].a.dot(d), 0.7, 1e-15);
}

TEST(PairGeometry, ABallIsReadByAnglesOnlyIfItsAxesAreNormal) {
  const PairConstants<double> c = pair_of({{"continuous", "1 0 0"}, {"continuous", "0 1 0"}, {"continuous", "0 0 1"}});
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kAngle);
  EXPECT_EQ(c.coordinates[1].kind, CoordinateKind::kSine);
  EXPECT_EQ(c.coordinates[2].kind, CoordinateKind::kAngle);
  const PairConstants<double> oblique = pair_of({{"continuous", "1 0 0"}, {"continuous", "0.6 0.8 0"}, {"continuous", "0 0 1"}});
  for (const auto& coordinate : oblique.coordinates) EXPECT_EQ(coordinate.kind, CoordinateKind::kNone);
}

TEST(PairGeometry, ADistanceHasTwoPointsThatNeedNotCoincide) {
  const RobotDescription robot = read_urdf(pendulum(
      "<axis xyz='0 1 0'/>",
      "<loop name='rod' type='codesign:distance'><codesign:length value='2'/><predecessor link='ground'><origin xyz='1 0 0'/></predecessor>"
      "<successor link='arm'><origin xyz='0 0 -1'/></successor></loop>"));
  const Topology topology = derive_topology(robot);
  const PairConstants<double> c =
      pair_constants<double>(robot, topology, topology.pairs.at(1), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {0.2});
  EXPECT_EQ(c.distance, 2.0);
  EXPECT_LT((c.s_i - kUnitX).norm(), 1e-15);
  EXPECT_LT((c.s_j + kUnitZ).norm(), 1e-15) << "the two ends need not coincide";
}

}  // namespace
}  // namespace codesign
