// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations_fixture.h"

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
  const Eigen::Vector3d sum = G.segment<3>(0) + G.segment<3>(kBodySize) - Eigen::Vector3d(0.0, 0.0, 9.81 * mass);
  real.formulas().load(state);
  const SpringForce<double> hook = real.formulas().spring(1);
  EXPECT_LT((sum - hook.pull).norm(), 1e-13);
  EXPECT_NEAR(hook.tension, 10.0 * (hook.length - 0.1), 1e-13);
  const Eigen::Vector3d along =
      (real.formulas().body(0).r + real.formulas().body(0).A * real.constants().springs[1].s_j) - Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NEAR(hook.length, along.norm(), 1e-13);
}

}  // namespace
}  // namespace codesign
