// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "elements/spring_damper.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"

namespace codesign {
namespace {

/// Springs between two bodies (damped) and between the ground and a body (not damped).
const char* const kSpringMechanism = R"(
<robot name="springs" xmlns:codesign="urn:test">
  <codesign:parameter name="k" value="30"/>
  <link name="ground"/>
  <link name="a"><inertial><origin xyz="0.1 0 -0.2" rpy="0.1 0.2 0.3"/><mass value="0.7"/>
    <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.018" iyz="0" izz="0.01"/></inertial></link>
  <link name="b"><inertial><mass value="0.3"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <joint name="free_a" type="floating"><parent link="ground"/><child link="a"/></joint>
  <joint name="free_b" type="floating"><parent link="ground"/><child link="b"/></joint>
  <codesign:spring_damper name="between" stiffness="30" codesign:stiffness="${k}" damping="2" free_length="0.4">
    <predecessor link="a"><origin xyz="0.1 0.2 0"/></predecessor><successor link="b"><origin xyz="0 0 0.3"/></successor></codesign:spring_damper>
  <codesign:spring_damper name="hook" stiffness="10" free_length="0.1"><predecessor link="ground"><origin xyz="0 0 1"/></predecessor>
    <successor link="a"/></codesign:spring_damper>
</robot>)";

const char* const kSpringStudy = R"(
duration: 1.0
initial_state: {}
controllers: {}
parameters: {}
objective: {integral: [{signal: a/position/x}], terminal: []}
solver: {integrator: rosenbrock}
optimizer: {algorithm: lbfgs}
)";

class EquationsSpringsTest : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsSpringsTest() : EquationsFixture(kSpringMechanism, kSpringStudy) {}
};

TEST_F(EquationsSpringsTest, EveryDerivativeIsExact) { expect_exact_derivatives(1e-11); }

TEST_F(EquationsSpringsTest, PullsAreEqualAndOpposite) {
  // Without gravity the sum of all forces is what the hook exerts on the ground.
  VectorX<double> G;
  double g = 0.0;
  state.z.setZero();
  real.residual(state, &G, &g);
  const double mass = real.constants().bodies[0].mass + real.constants().bodies[1].mass;
  const Eigen::Vector3d sum =
      G.segment<3>(0) + G.segment<3>(kBodySize) - Eigen::Vector3d(0.0, 0.0, 9.81 * mass);
  real.formulas().load(state);
  const SpringForce<double> hook = spring_at(real.formulas().view(), 1);
  EXPECT_LT((sum - hook.pull).norm(), 1e-13);
  EXPECT_NEAR(hook.tension, 10.0 * (hook.length - 0.1), 1e-13);
  const Eigen::Vector3d along =
      (real.formulas().body(0).r + real.formulas().body(0).A * real.constants().springs[1].s_j) -
      Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NEAR(hook.length, along.norm(), 1e-13);
}

/// A body of 2 kg whose centre lies off its link frame, and which flies.
std::string flyer() {
  return robot(
      "<codesign:parameter name='push' value='2'/>"
      "<link name='box'><inertial><origin xyz='0.1 0 0.2' rpy='0 0 0'/><mass value='2'/><inertia "
      "ixx='0.1' ixy='0' ixz='0' iyy='0.2' "
      "iyz='0' "
      "izz='0.25'/></inertial></link><joint name='free' type='floating'><parent "
      "link='ground'/><child link='box'/></joint>");
}

std::string loaded_study(const std::string& loads) {
  return "duration: 1.0\ngravity: [0, 0, 0]\nobjective: {integral: [{signal: box/position/x}, "
         "{signal: mechanism/load_power}]}\nloads: [" +
         loads + "]\n";
}

const char* const kInRoot =
    "{link: box, force: [\"${push}\", -1.0, 0.5], torque: [0.3, 0.2, \"${push/5}\"], point: [0.1, "
    "-0.2, 0.3]}";
const char* const kInLink =
    "{link: box, force: [\"${push}\", -1.0, 0.5], torque: [0.3, 0.2, \"${push/5}\"], point: [0.1, "
    "-0.2, 0.3], frame: link}";

TEST(ConstantLoads, DerivativesAreExact) {
  for (const std::string& loads :
       {std::string(kInRoot), std::string(kInLink), std::string(kInRoot) + ", " + kInLink}) {
    EquationsFixture e(flyer(), loaded_study(loads));
    e.expect_exact_derivatives(1e-10);
  }
  EquationsFixture arm(double_pendulum(pin_friction()),
                       let_go("{}", "elbow/velocity", "loads: [{joint: elbow, effort: 2.0}]\n"));
  arm.expect_exact_derivatives(1e-10);
}

/// Newton's and Euler's accelerations of the box under a wrench in ground axes at its start, where
/// the axes agree.
void expect_accelerations(const std::string& loads, const Eigen::Vector3d& force,
                          const Eigen::Vector3d& torque) {
  Compiled c(flyer(), loaded_study(loads));
  ASSERT_TRUE(c.start().ok());
  EXPECT_LT((c.state.z.head<3>() - force / 2.0).norm(), 1e-14);
  const Eigen::Vector3d inertia(0.1, 0.2, 0.25), spin = 2.0 * c.state.z.segment<3>(4);
  EXPECT_LT((spin - torque.cwiseQuotient(inertia)).norm(), 1e-13);
}

TEST(ConstantLoads, AWrenchOnABodyByHand) {
  const Eigen::Vector3d force(2.0, -1.0, 0.5), torque(0.3, 0.2, 0.4),
      lever = Eigen::Vector3d(0.1, -0.2, 0.3) - Eigen::Vector3d(0.1, 0.0, 0.2);
  expect_accelerations(kInRoot, force, torque + lever.cross(force));
  expect_accelerations(kInLink, force, torque + lever.cross(force));
}

// With the link turned by a quarter about z, one wrench turns with it and the other does not.
TEST(ConstantLoads, FramesOfAWrench) {
  const std::string turned = "initial_state: {free: {rotation: [0, 0, 1.5707963267948966]}}\n";
  const auto acceleration = [&](const std::string& loads) {
    Compiled c(flyer(), loaded_study(loads) + turned);
    EXPECT_TRUE(c.start().ok());
    return Eigen::Vector3d(c.state.z.head<3>());
  };
  EXPECT_LT((acceleration("{link: box, force: [2, 0, 0]}") - Eigen::Vector3d(1.0, 0.0, 0.0)).norm(),
            1e-14);
  EXPECT_LT(
      (acceleration("{link: box, force: [2, 0, 0], frame: link}") - Eigen::Vector3d(0.0, 1.0, 0.0))
          .norm(),
      1e-14);
}

TEST(ConstantLoads, AnEffortIsALoadAlongTheJoint) {
  Compiled c(pendulum(), let_go("{}", "hinge/velocity",
                                "gravity: [0, 0, 0]\nloads: [{joint: hinge, effort: 1.0}, {joint: "
                                "hinge, effort: 0.5}]\n"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().coordinate(0, 0).acceleration, 1.5 / (0.0834 + 0.25), 1e-12);
  EXPECT_EQ(c.equations.formulas().effort(0, 0), 0.0) << "controllers' alone";
}

TEST(ConstantLoads, RefuseWhatCannotBeLoaded) {
  const auto fault = [](const std::string& loads) {
    try {
      Compiled c(
          robot(bar("bar") + "<link name='tip'/><link name='frame'/>" +
                hinge("hinge", "ground", "bar", "0 0 0") + hinge("needle", "bar", "tip", "0 0 -1") +
                "<joint name='weld' type='fixed'><parent link='ground'/><child "
                "link='frame'/></joint>"),
          "duration: 1.0\nloads: [" + loads + "]\n");
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.line, 2);
      return error.fault().message;
    }
    return std::string("accepted");
  };
  EXPECT_NE(fault("{link: ground, force: [1, 0, 0]}").find("the ground"), std::string::npos);
  EXPECT_NE(fault("{link: frame, force: [1, 0, 0]}").find("the ground"), std::string::npos);
  EXPECT_NE(fault("{link: tip, force: [1, 0, 0]}").find("no <inertial>"), std::string::npos);
  EXPECT_NE(fault("{joint: needle, effort: 1}").find("without <inertial>"), std::string::npos);
  EXPECT_EQ(fault("{joint: hinge, effort: 1}"), "accepted");
}

}  // namespace

}  // namespace codesign
