// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/urdf/urdf_reader.h"

#include <cmath>

#include "mechanism/mass_properties.h"
#include "paths.h"
#include "reading/urdf/urdf_fixture.h"

namespace codesign {
namespace {

const char kEnds[] = "<predecessor link=\"ground\"/><successor link=\"arm\"/>";

SourceText coupling_text(const std::string& content) {
  return hinged_arm("", "<coupling name=\"c\">" + content + "</coupling>");
}

TEST(AnnotatedUrdf, Couplings) {
  const RobotDescription robot = read_urdf(
      coupling_text(std::string(kEnds) + R"(<ratio value="0.4" codesign:value="${2*length}"/>)"));
  ASSERT_EQ(robot.couplings.size(), 1u);
  EXPECT_EQ(robot.couplings[0].predecessor, 0);
  EXPECT_EQ(robot.couplings[0].successor, 1);
  EXPECT_DOUBLE_EQ(robot.couplings[0].ratio.at(std::vector<double>{0.3}), 0.6);
  expect_error(coupling_text(kEnds),
               {"test.urdf:3: <coupling name=\"c\">: the element <ratio> is missing"});
  expect_error(coupling_text(std::string(kEnds) + "<ratio value=\"0\"/>"), {"the ratio is zero"});
  expect_error(
      coupling_text("<predecessor link=\"arm\"/><successor link=\"arm\"/><ratio value=\"1\"/>"),
      {"the same link"});
}

RobotDescription shipped(const std::string& name) {
  return read_urdf(read_source(source_dir() + "/urdf/" + name + ".urdf"));
}

/// Pose of a link in the root's frame with all joints at zero.
void pose_at_zero(const RobotDescription& robot, int link, const std::vector<double>& at,
                  Matrix3<double>* R, Vector3<double>* t) {
  *R = Matrix3<double>::Identity();
  *t = Vector3<double>::Zero();
  for (bool found = true; found;) {
    found = false;
    for (const JointDescription& joint : robot.joints) {
      if (joint.is_loop || joint.child != link) continue;
      const Matrix3<double> R_j =
          rotation_from_rpy<double>(internal::values_at(joint.origin.rpy, at));
      *t = R_j * *t + internal::values_at(joint.origin.xyz, at);
      *R = R_j * *R;
      link = joint.parent;
      found = true;
      break;
    }
  }
}

/// Closure error of the universal loop: distance of its points, and cosine between its axes.
/// @param slider position of the slider's joint, along x; the others are at zero.
void loop_gap(const RobotDescription& robot, double slider, double* distance, double* cosine) {
  const std::vector<double> at = {0.08, 0.3, 0.05, 0.025};
  const JointDescription& loop = robot.joints.back();
  ASSERT_EQ(loop.type, JointType::kUniversal);
  Matrix3<double> R_i, R_j;
  Vector3<double> t_i, t_j;
  pose_at_zero(robot, loop.parent, at, &R_i, &t_i);
  pose_at_zero(robot, loop.child, at, &R_j, &t_j);
  *distance = (R_i * internal::values_at(loop.origin.xyz, at) + t_i - t_j -
               slider * Vector3<double>::UnitX())
                  .norm();
  *cosine = (R_i * internal::values_at(loop.axis, at))
                .dot(R_j * internal::values_at(loop.second_axis, at));
}

MassProperties<double> mass_of(const RobotDescription& robot, const std::string& link,
                               const std::vector<double>& at) {
  for (const LinkDescription& candidate : robot.links)
    if (candidate.name == link) return mass_properties(candidate.inertial.value(), at);
  throw std::out_of_range(link);
}

void expect_inertia(const MassProperties<double>& m, double mass, double x, double y, double z) {
  EXPECT_NEAR(m.mass, mass, 1e-12 * mass);
  const Matrix3<double> expected = Vector3<double>(x, y, z).asDiagonal();
  EXPECT_LT((m.inertia - expected).norm(), 1e-12 * expected.norm()) << m.inertia;
}

TEST(UrdfReader, FilesThatCannotBeRead) {
  EXPECT_THROW(read_source("/nonexistent/robot.urdf"), InputError);
  EXPECT_THROW(read_source("/"), InputError);
}

TEST(UrdfReader, TheSliderCrankIsThePapers) {
  const RobotDescription robot = shipped("slider_crank");
  ASSERT_EQ(robot.parameters.size(), 4u);
  EXPECT_EQ(robot.parameters[3].name, "slider_width");
  EXPECT_EQ(robot.parameters[3].upper, 0.03);
  EXPECT_EQ(robot.links[static_cast<std::size_t>(robot.root)].name, "ground");
  double distance = 1.0, cosine = 1.0;
  loop_gap(robot, 0.26057628441590763, &distance, &cosine);
  EXPECT_LT(distance, 1e-15);
  EXPECT_LT(std::abs(cosine), 1e-15);
  const std::vector<double> at = {0.08, 0.3, 0.05, 0.025};
  expect_inertia(mass_of(robot, "crank", at), 0.12, 1e-4, 1e-5, 1e-4);
  expect_inertia(mass_of(robot, "rod", at), 0.5, 4e-4, 4e-3, 4e-3);
  expect_inertia(mass_of(robot, "slider", at), 2.0, 2.0 * 0.00125 / 12.0, 2.0 * 0.003125 / 12.0,
                 2.0 * 0.003125 / 12.0);
  EXPECT_NEAR(mass_of(robot, "rod", at).centre[0], 0.15, 1e-16);
}

TEST(UrdfReader, TheSliderCrankGrowsWithItsParameters) {
  const RobotDescription robot = shipped("slider_crank");
  const std::vector<double> at = {0.1, 0.2, 0.06, 0.03};
  const double r = 0.1 / 0.08, L = 0.2 / 0.3,
               m = 2.0 * (0.06 * 0.03 * 0.03) / (0.05 * 0.025 * 0.025);
  expect_inertia(mass_of(robot, "crank", at), 0.12 * r, 1e-4 * r * r * r, 1e-5 * r,
                 1e-4 * r * r * r);
  expect_inertia(mass_of(robot, "rod", at), 0.5 * L, 4e-4 * L, 4e-3 * L * L * L, 4e-3 * L * L * L);
  expect_inertia(mass_of(robot, "slider", at), m, m * 0.0018 / 12.0, m * 0.0045 / 12.0,
                 m * 0.0045 / 12.0);
}

TEST(UrdfReader, HaugsSliderCrankKeepsItsMasses) {
  const RobotDescription robot = shipped("slider_crank_haug");
  double distance = 1.0, cosine = 1.0;
  loop_gap(robot, 0.2, &distance, &cosine);
  EXPECT_LT(distance, 1e-15);
  EXPECT_LT(std::abs(cosine), 1e-15);
  for (const std::vector<double>& at :
       {std::vector<double>{0.08, 0.3, 0.05, 0.025}, {0.1, 0.2, 0.06, 0.03}}) {
    expect_inertia(mass_of(robot, "crank", at), 0.12, 1e-4, 1e-5, 1e-4);
    expect_inertia(mass_of(robot, "rod", at), 0.5, 4e-3, 4e-4, 4e-3);
    expect_inertia(mass_of(robot, "slider", at), 2.0, 1e-4, 1e-4, 1e-4);
  }
  const FrictionDescription& friction = robot.joints[4].friction.value();
  EXPECT_EQ(friction.joint_width.at(std::vector<double>{0.0, 0.0, 0.0, 0.03}), 0.03);
  EXPECT_EQ(friction.smoothing.nominal(), 0.01);
}

}  // namespace
}  // namespace codesign
