// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "mechanism/pair_geometry.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

/// ground - yaw (z, at height 1) - massless fork - pitch (y, 0.5 further up, turned about z by a
/// right angle) - arm.
const RobotDescription& robot() {
  static const RobotDescription robot = read_urdf(robot_text(
      kGround + link_with("fork", "") + link_with("arm") +
      joint_with("yaw", "continuous", "ground", "fork",
                 "<origin xyz='0 0 1'/><axis xyz='0 0 1'/>") +
      joint_with("pitch", "continuous", "fork", "arm",
                 "<origin xyz='0 0 0.5' rpy='0 0 1.5707963267948966'/><axis xyz='0 2 0'/>")));
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
  EXPECT_LT((g.axes[1] - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-15)
      << "the unit of y, turned about z";
  EXPECT_LT((g.X_ij.t - Eigen::Vector3d(0.0, 0.0, 1.5)).norm(), 1e-15);
}

TEST(ChainGeometry, WalkedBackwardsItIsTheInverse) {
  const Pose<double> there = geometry({{0, false}, {1, false}}).X_ij,
                     back = geometry({{1, true}, {0, true}}).X_ij;
  const Pose<double> round = there * back;
  EXPECT_LT((round.R - Eigen::Matrix3d::Identity()).norm(), 1e-15);
  EXPECT_LT(round.t.norm(), 1e-15);
}

TEST(NearestPoint, IsWhereLinesMeetOrComeClosest) {
  using V = Vector3<double>;
  // The line along x at y = 2 and the line along y at x = 3 intersect; with the second one at z = 1
  // they do not.
  for (double lift : {0.0, 1.0})
    EXPECT_LT(
        (nearest_point<double>(V(-5, 2, 0), V::UnitX(), V(3, 7, lift), V::UnitY()) - V(3, 2, 0))
            .norm(),
        1e-14);
  const V oblique = V(1, 1, 0).normalized();
  EXPECT_LT(
      (nearest_point<double>(V(0, 0, 0), V::UnitX(), V(4, 1, 0), oblique) - V(3, 0, 0)).norm(),
      1e-14);
}

using CoordinateKind = CoordinateConstants<double>::Kind;

struct ChainElement {
  const char *type, *axis;
  const char* origin = "";
};

/// The pair of a chain from the ground across massless links to an arm.
PairConstants<double> pair_of(const std::vector<ChainElement>& elements,
                              const std::string& friction = "") {
  std::string text = kGround;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const bool last = k + 1 == elements.size();
    const std::string child = last ? "arm" : "m" + std::to_string(k);
    text += link_with(child, last ? kInertial : "") +
            joint_with("j" + std::to_string(k), elements[k].type,
                       k == 0 ? "ground" : "m" + std::to_string(k - 1), child,
                       "<origin " + std::string(elements[k].origin) + "/><axis xyz='" +
                           elements[k].axis + "'/><limit effort='1' velocity='1'/>" +
                           (last ? friction : ""));
  }
  const RobotDescription robot = read_urdf(robot_text(text));
  const Topology topology = derive_topology(robot);
  return pair_constants<double>(robot, topology, topology.pairs.at(0), Eigen::Vector3d::Zero(),
                                Eigen::Vector3d(0.0, 0.0, 0.5), {0.2});
}

void expect_frame(const Eigen::Matrix3d& C, const Eigen::Vector3d& x, const Eigen::Vector3d& z) {
  EXPECT_LT((C.col(0) - x).norm(), 1e-15);
  EXPECT_LT((C.col(1) - z.cross(x)).norm(), 1e-15);
  EXPECT_LT((C.col(2) - z).norm(), 1e-15);
}

const Eigen::Vector3d kUnitX = Eigen::Vector3d::UnitX(), kUnitY = Eigen::Vector3d::UnitY(),
                      kUnitZ = Eigen::Vector3d::UnitZ();

TEST(PairGeometry, AHingeHasItsPointAndAxesOnBothBodies) {
  const PairConstants<double> c =
      pair_of({{"continuous", "0 0 3", "xyz='1 2 3' rpy='0 1.5707963267948966 0'"}});
  EXPECT_LT((c.s_i - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 1e-15);
  EXPECT_LT((c.s_j - Eigen::Vector3d(0.0, 0.0, -0.5)).norm(), 1e-15)
      << "seen from the centre of mass";
  // The pitch by a right angle takes z to x and x to -z; x'' follows z in the joint frame: it is
  // its x.
  expect_frame(c.C_i, -kUnitZ, kUnitX);
  expect_frame(c.C_j, kUnitX, kUnitZ);
  ASSERT_EQ(c.coordinates.size(), 1U);
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kTurn);
}

TEST(PairGeometry, FrictionMayChooseTheTransverseAxis) {
  const std::string friction =
      "<codesign:friction mu_static='0.3' mu_dynamic='0.2' joint_length='0.1' joint_width='0.05' "
      "transverse_axis='0 1 0'/>";
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
  // d = u0 x + u1 (0.6, 0.8, 0): the vector of each coordinate must give its own slide and be
  // normal to the other's axis.
  const Eigen::Vector3d d = 0.3 * kUnitX + 0.7 * Eigen::Vector3d(0.6, 0.8, 0.0);
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kSlide);
  EXPECT_NEAR(c.coordinates[0].a.dot(d), 0.3, 1e-15);
  EXPECT_NEAR(c.coordinates[1].a.dot(d), 0.7, 1e-15);
}

TEST(PairGeometry, ABallIsReadByAnglesOnlyIfItsAxesAreNormal) {
  const PairConstants<double> c =
      pair_of({{"continuous", "1 0 0"}, {"continuous", "0 1 0"}, {"continuous", "0 0 1"}});
  EXPECT_EQ(c.coordinates[0].kind, CoordinateKind::kAngle);
  EXPECT_EQ(c.coordinates[1].kind, CoordinateKind::kSine);
  EXPECT_EQ(c.coordinates[2].kind, CoordinateKind::kAngle);
  const PairConstants<double> oblique =
      pair_of({{"continuous", "1 0 0"}, {"continuous", "0.6 0.8 0"}, {"continuous", "0 0 1"}});
  for (const auto& coordinate : oblique.coordinates)
    EXPECT_EQ(coordinate.kind, CoordinateKind::kNone);
}

TEST(PairGeometry, ADistanceHasTwoPointsThatNeedNotCoincide) {
  const RobotDescription robot = read_urdf(
      hinged_arm("<axis xyz='0 1 0'/>",
                 "<loop name='rod' type='codesign:distance'><codesign:length "
                 "value='2'/><predecessor link='ground'><origin xyz='1 0 0'/></predecessor>"
                 "<successor link='arm'><origin xyz='0 0 -1'/></successor></loop>"));
  const Topology topology = derive_topology(robot);
  const PairConstants<double> c =
      pair_constants<double>(robot, topology, topology.pairs.at(1), Eigen::Vector3d::Zero(),
                             Eigen::Vector3d::Zero(), {0.2});
  EXPECT_EQ(c.distance, 2.0);
  EXPECT_LT((c.s_i - kUnitX).norm(), 1e-15);
  EXPECT_LT((c.s_j + kUnitZ).norm(), 1e-15) << "the two ends need not coincide";
}

/// The error that the check throws; empty if it passes.
std::string complaint(const FrictionDescription& friction, JointType type) {
  JointDescription joint;
  joint.type = type;
  try {
    check_friction_geometry(friction, kind_of(joint), "<joint>");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FrictionGeometry, EachJointTypeNeedsItsDimensions) {
  FrictionDescription friction;
  friction.where = {"a.urdf", 3};
  EXPECT_EQ(complaint(friction, JointType::kPlanar), "");
  EXPECT_EQ(complaint(friction, JointType::kPrismatic),
            "a.urdf:3: <joint>: the friction of this joint type needs the attribute joint_length "
            "(allowed: > 0)");
  friction.joint_length = 0.1;
  EXPECT_NE(complaint(friction, JointType::kPrismatic).find("joint_width"), std::string::npos);
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kCylindrical,
                         JointType::kSpherical})
    EXPECT_NE(complaint(friction, type).find("pin_radius"), std::string::npos);
  friction.joint_width = 0.1;
  EXPECT_EQ(complaint(friction, JointType::kPrismatic), "");
  friction.pin_radius = 0.1;
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kCylindrical,
                         JointType::kSpherical})
    EXPECT_EQ(complaint(friction, type), "");
}

TEST(FrictionGeometry, WhatSlipsInSeveralDirectionsHasNoBackward) {
  FrictionDescription friction;
  friction.joint_length = friction.joint_width = friction.pin_radius = 0.1;
  friction.is_directional = true;
  for (JointType type : {JointType::kPrismatic, JointType::kRevolute, JointType::kContinuous,
                         JointType::kCylindrical})
    EXPECT_EQ(complaint(friction, type), "");
  for (JointType type : {JointType::kSpherical, JointType::kPlanar})
    EXPECT_NE(complaint(friction, type).find("slips in several directions"), std::string::npos);
}

TEST(FrictionGeometry, SomeJointsHaveNoFrictionLaw) {
  FrictionDescription friction;
  friction.joint_length = friction.joint_width = friction.pin_radius = 0.1;
  for (JointType type :
       {JointType::kFixed, JointType::kFloating, JointType::kUniversal, JointType::kDistance})
    EXPECT_NE(complaint(friction, type).find("no friction law"), std::string::npos);
}

}  // namespace

}  // namespace codesign
