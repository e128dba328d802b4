// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <cmath>

#include "mechanism/pose.h"
#include "mechanism/topology.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

constexpr double kQuarter = 1.5707963267948966;

Pose<double> pose(double x, double y, double z, double roll, double pitch, double yaw) {
  PoseDescription origin;
  origin.xyz = {x, y, z};
  origin.rpy = {roll, pitch, yaw};
  return pose_at<double>(origin, {});
}

TEST(Pose, RollPitchYawTurnAboutFixedAxesInThisOrder) {
  const Pose<double> X = pose(1.0, 2.0, 3.0, kQuarter, 0.0, kQuarter);
  // The roll takes y to z, which the yaw leaves; the yaw takes x to y.
  EXPECT_LT((X * Vector3<double>(0.0, 1.0, 0.0) - Vector3<double>(1.0, 2.0, 4.0)).norm(), 1e-15);
  EXPECT_LT((X * Vector3<double>(1.0, 0.0, 0.0) - Vector3<double>(1.0, 3.0, 3.0)).norm(), 1e-15);
}

TEST(Pose, ComposesFromLeftToRightAndInverts) {
  const Pose<double> X = pose(1.0, 0.0, 0.0, 0.0, 0.0, kQuarter),
                     Y = pose(0.0, 2.0, 0.0, 0.3, -0.2, 0.1);
  const Vector3<double> s(0.5, -1.0, 0.25);
  EXPECT_LT(((X * Y) * s - X * (Y * s)).norm(), 1e-15);
  EXPECT_LT((X.inverse() * (X * s) - s).norm(), 1e-15);
  EXPECT_LT((X * Y.t - Vector3<double>(-1.0, 0.0, 0.0)).norm(), 1e-15);
}

TEST(Pose, AxisIsMadeAUnitVector) {
  EXPECT_LT((axis_at<double>({0.0, 3.0, -4.0}, {}) - Vector3<double>(0.0, 0.6, -0.8)).norm(),
            1e-15);
}

TEST(Pose, LinkInBaseWalksThroughFixedJoints) {
  const RobotDescription robot = read_urdf(robot_text(
      kGround + link_with("arm") + link_with("hand") +
      joint_with("hinge", "continuous", "ground", "arm", "<origin xyz='9 9 9'/>") +
      joint_with("wrist", "fixed", "arm", "palm",
                 "<origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/>") +
      link_with("palm") + joint_with("grip", "fixed", "palm", "hand", "<origin xyz='1 0 0'/>")));
  const Topology topology = derive_topology(robot);
  const auto link = [&](const std::string& name) {
    int index = 0;
    while (robot.links[static_cast<std::size_t>(index)].name != name) ++index;
    return link_in_base<double>(robot, topology.link_base, topology.link_parent_joint, index,
                                {0.2});
  };
  EXPECT_EQ(link("arm").t.norm(), 0.0)
      << "a base link lies in itself; the hinge above it does not count";
  EXPECT_LT((link("hand").t - Vector3<double>(0.0, 1.0, 1.0)).norm(), 1e-15);
}

TEST(TransverseAxis, IsTheNextAxisInOrder) {
  const auto of = [](double x, double y, double z) {
    return transverse_axis<double>(Vector3<double>(x, y, z), std::nullopt);
  };
  EXPECT_EQ(of(1, 0, 0), Eigen::Vector3d::UnitY());
  EXPECT_EQ(of(0, 1, 0), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(of(0, 0, -1), Eigen::Vector3d::UnitX());
}

TEST(TransverseAxis, IsMadeNormalToTheAxisAndOfUnitLength) {
  const Vector3<double> z = Vector3<double>(0.2, 0.9, -0.4).normalized();
  for (const auto& preferred : {std::optional<std::array<double, 3>>(),
                                std::optional<std::array<double, 3>>({3.0, 1.0, 0.0})}) {
    const Vector3<double> x = transverse_axis<double>(z, preferred);
    EXPECT_NEAR(x.dot(z), 0.0, 1e-15);
    EXPECT_NEAR(x.norm(), 1.0, 1e-15);
  }
}

struct Step {
  bool turns;
  Vector3<double> axis;
};

std::vector<Step> steps_of(JointType type) {
  JointDescription joint;
  joint.type = type;
  joint.axis = {Quantity(0.0), Quantity(3.0), Quantity(4.0)};
  std::vector<Step> steps;
  visit_freedoms(joint, std::vector<double>(), [&](bool turns, const Vector3<double>& axis) {
    steps.push_back({turns, axis});
  });
  return steps;
}

TEST(VisitFreedoms, HingesAndSlidesHaveOneAlongTheUnitAxis) {
  for (JointType type : {JointType::kRevolute, JointType::kContinuous, JointType::kPrismatic}) {
    const std::vector<Step> steps = steps_of(type);
    ASSERT_EQ(steps.size(), 1u);
    EXPECT_EQ(steps[0].turns, type != JointType::kPrismatic);
    EXPECT_LT((steps[0].axis - Vector3<double>(0.0, 0.6, 0.8)).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(VisitFreedoms, APlanarJointSlidesInItsPlaneAndTurnsAboutTheNormal) {
  const std::vector<Step> steps = steps_of(JointType::kPlanar);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_FALSE(steps[0].turns || steps[1].turns);
  EXPECT_TRUE(steps[2].turns);
  EXPECT_LT((steps[0].axis.cross(steps[1].axis) - steps[2].axis).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(VisitFreedoms, AFloatingJointHasSixAndAFixedOneNone) {
  const std::vector<Step> steps = steps_of(JointType::kFloating);
  ASSERT_EQ(steps.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    EXPECT_EQ(steps[static_cast<std::size_t>(k)].turns, k >= 3);
    EXPECT_EQ(steps[static_cast<std::size_t>(k)].axis,
              Vector3<double>(Vector3<double>::Unit(k % 3)));
  }
  EXPECT_TRUE(steps_of(JointType::kFixed).empty());
}

}  // namespace

}  // namespace codesign
