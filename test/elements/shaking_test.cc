// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// What a mechanism exerts on the ground by its motion, theory (11b): by hand, and against the
// reactions of the joints on the ground.
#include "elements/shaking.h"

#include <gtest/gtest.h>

#include "equations/compiled.h"
#include "equations/generic_state.h"
#include "equations/joint_cases.h"

namespace codesign {
namespace {

double shaking_value(Compiled* c, const std::string& text) {
  return c->equations.formulas().signal(
      resolve_signal(parse_signal(text, {}, "test"), c->system.robot(), c->system.topology(),
                     c->system.study().controllers),
      c->state);
}

Eigen::Vector3d shaking_vector(Compiled* c, const std::string& quantity,
                               const std::string& axes = "") {
  return {shaking_value(c, quantity + "/x" + axes), shaking_value(c, quantity + "/y" + axes),
          shaking_value(c, quantity + "/z" + axes)};
}

/// A disc on an axis z through (0.5, 0, 0), its centre of mass 0.1 m off, with a point of the
/// ground that is turned about z by a right angle.
std::string unbalanced_disc(const std::string& actuator) {
  return robot(
      "<link name='disc'><inertial><origin xyz='0.1 0 0'/><mass value='3'/><inertia ixx='0.1' "
      "ixy='0' ixz='0.02' iyy='0.1' iyz='0' izz='0.2'/></inertial></link><link name='foot'/>"
      "<joint name='axle' type='continuous'><parent link='ground'/><child link='disc'/><origin "
      "xyz='0.5 0 0'/><axis xyz='0 0 1'/>" +
      actuator +
      "</joint><joint name='stand' type='fixed'><parent link='ground'/><child link='foot'/><origin "
      "xyz='0 0 -1' rpy='0 0 1.5707963267948966'/></joint>");
}

// At the angle zero, with rate w and acceleration a: r'' = (-e w^2, e a, 0).
TEST(Shaking, OfAnUnbalancedDiscByHand) {
  constexpr double kRate = 20.0, kMass = 3.0, kOff = 0.1, kX = 0.6;
  for (const double inertia : {0.0, 0.004}) {
    const std::string actuator =
        inertia > 0.0 ? "<codesign:actuator gear_ratio='5' rotor_inertia='0.004'/>" : "";
    Compiled c(unbalanced_disc(actuator),
               "duration: 1.0\nloads: [{joint: axle, effort: 2.3}]\ninitial_state: {axle: "
               "{position: 0, velocity: 20}}\n");
    ASSERT_TRUE(c.start().ok());
    const double a = 2.3 / (0.2 + kMass * kOff * kOff + 25.0 * inertia);
    EXPECT_NEAR(shaking_value(&c, "axle/acceleration"), a, 1e-10);
    const Eigen::Vector3d force(kMass * kOff * kRate * kRate, -kMass * kOff * a, 0.0);
    EXPECT_LT((shaking_vector(&c, "mechanism/shaking_force") - force).norm(), 1e-9);
    // J omega' + omega x J omega, and the rate of the rotor's spin, n J_r a about z.
    const double ixz = 0.02;
    const Eigen::Vector3d turning(ixz * a, ixz * kRate * kRate, 0.2 * a + 5.0 * inertia * a);
    const Eigen::Vector3d moment = Eigen::Vector3d(kX, 0, 0).cross(force) - turning;
    EXPECT_LT((shaking_vector(&c, "mechanism/shaking_moment") - moment).norm(), 1e-9) << inertia;
    // About the foot, 1 m below, whose x is the ground's y and whose y is the ground's -x.
    const Eigen::Vector3d about = moment - Eigen::Vector3d(0, 0, -1).cross(force);
    EXPECT_LT((shaking_vector(&c, "mechanism/shaking_moment", "@foot") -
               Eigen::Vector3d(about.y(), -about.x(), about.z()))
                  .norm(),
              1e-9);
    EXPECT_LT((shaking_vector(&c, "mechanism/shaking_force", "@foot") -
               Eigen::Vector3d(force.y(), -force.x(), 0.0))
                  .norm(),
              1e-9);
  }
}

/// The wrench that the joints on the ground exert on the mechanism, about the ground's origin.
struct OnMechanism {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();

  explicit OnMechanism(Compiled* c) {
    const RobotDescription& robot = c->system.robot();
    for (const JointDescription& joint : robot.joints) {
      if (joint.parent != robot.root || joint.type == JointType::kFixed) continue;
      const Eigen::Vector3d f = shaking_vector(c, joint.name + "/reaction_force", "@ground"),
                            t = shaking_vector(c, joint.name + "/reaction_torque", "@ground"),
                            at = shaking_vector(
                                c, robot.links[static_cast<std::size_t>(joint.child)].name +
                                       "/position");
      force += f;
      moment += at.cross(f) + t;
    }
  }
};

class ShakingMachine : public ::testing::TestWithParam<const char*> {};

// Two cranks on the ground with a coupler between them, all with products of inertia, in space
// without gravity, so that nothing but the motion acts on the ground.
TEST_P(ShakingMachine, IsTheOppositeOfWhatTheGroundExertsThroughTheJoints) {
  const auto link = [](const std::string& name, const std::string& at) {
    return "<link name='" + name + "'><inertial><origin xyz='" + at +
           "'/><mass value='1.3'/><inertia ixx='0.1' ixy='0.01' ixz='0.02' iyy='0.12' iyz='-0.01' "
           "izz='0.2'/></inertial></link>";
  };
  const auto hinge = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& at) {
    return "<joint name='" + name + "' type='continuous'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + at + "'/><axis xyz='0 1 0'/></joint>";
  };
  Compiled c(robot(link("crank", "0.1 0.03 0.2") + link("coupler", "0.4 -0.02 0.1") +
                   link("rocker", "0 0.05 0.3") + hinge("a", "ground", "crank", "0 0 0") +
                   hinge("b", "crank", "coupler", "0 0 0.4") +
                   hinge("d", "ground", "rocker", "0.9 0 0.1") +
                   "<loop name='c' type='revolute' codesign:out_of_plane='zero'><predecessor "
                   "link='coupler'><origin xyz='0.8 0 0'/></predecessor><successor "
                   "link='rocker'><origin xyz='0 0 0.6'/></successor><axis xyz='0 1 0'/></loop>"),
             std::string("duration: 1.0\ngravity: [0, 0, 0]\nloads: [{joint: a, effort: 0.4}]\n"
                         "initial_state: {a: {position: 0.3, velocity: 7}, d: {guess: 0.3}}\n"
                         "solver: {coordinates: ") +
                 GetParam() + "}\n");
  ASSERT_TRUE(c.start().ok());
  const OnMechanism of(&c);
  ASSERT_GT(of.force.norm(), 1.0);
  EXPECT_LT((shaking_vector(&c, "mechanism/shaking_force") + of.force).norm(),
            1e-9 * of.force.norm());
  EXPECT_LT((shaking_vector(&c, "mechanism/shaking_moment") + of.moment).norm(),
            1e-9 * of.moment.norm());
}

// With gravity the joints carry the weight, too.
TEST_P(ShakingMachine, LeavesOutTheWeight) {
  Compiled c(robot(bar("upper") + bar("lower") +
                   "<joint name='shoulder' type='continuous'><parent link='ground'/><child "
                   "link='upper'/><axis xyz='0 1 0.2'/></joint><joint name='elbow' "
                   "type='continuous'><parent link='upper'/><child link='lower'/><origin xyz='0 0 "
                   "-1'/><axis xyz='1 0.3 0'/></joint>"),
             std::string("duration: 1.0\nsolver: {coordinates: ") + GetParam() + "}\n");
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  const OnMechanism of(&c);
  const Eigen::Vector3d weight(0, 0, -2.0 * 9.81);
  EXPECT_LT((shaking_vector(&c, "mechanism/shaking_force") + of.force + weight).norm(),
            1e-9 * of.force.norm());
}

INSTANTIATE_TEST_SUITE_P(Coordinates, ShakingMachine, ::testing::Values("absolute", "joint"));

}  // namespace
}  // namespace codesign
