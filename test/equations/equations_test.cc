// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "equations/equations.h"

#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "system/system.h"

namespace codesign {
namespace {

/// Every kind of load, signal and pair that has derivatives: friction in a slide, a hinge (by
/// direction) and a cylindrical loop, damping, a PID with all gains.
const char* const kMechanism = R"(
<robot name="all" xmlns:codesign="urn:test"><link name="ground"/>
  <link name="cart"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.1 0 -0.2" rpy="0.1 0.2 0.3"/><mass value="0.7"/>
    <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.018" iyz="0" izz="0.01"/></inertial></link>
  <link name="fork"/>
  <link name="tip"><inertial><mass value="0.3"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="cart"/><axis xyz="1 0 0"/><limit effort="1" velocity="1"/>
    <dynamics damping="0.4" friction="0.2"/>
    <codesign:friction mu_static="0.4" mu_dynamic="0.3" transition_velocity="0.5" joint_length="0.1" joint_width="0.05"/></joint>
  <joint name="hinge" type="continuous"><parent link="cart"/><child link="arm"/><origin xyz="0.1 0 0" rpy="0.2 0 0"/><axis xyz="0 1 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.5" joint_length="0.05" pin_radius="0.1" viscous="0.01"
      mu_static_backward="0.2" mu_dynamic_backward="0.1" viscous_backward="0.04"/></joint>
  <joint name="yaw" type="continuous"><parent link="arm"/><child link="fork"/><origin xyz="0 0 -0.4"/><axis xyz="0 0 1"/></joint>
  <joint name="roll" type="continuous"><parent link="fork"/><child link="tip"/><axis xyz="1 0 0"/></joint>
  <loop name="guide" type="codesign:cylindrical"><predecessor link="ground"><origin xyz="0 0 -0.4"/></predecessor>
    <successor link="tip"/><axis xyz="1 0 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.5" joint_length="0.05" pin_radius="0.1"/></loop>
</robot>)";

const char* const kStudy = R"(
duration: 1.0
initial_state: {}
controllers:
  servo: {type: pid, input: hinge/position - tip/position/x, setpoint: 0.3, output: hinge, gains: {p: 3.0, i: 2.0, d: 0.5}}
parameters: {}
objective:
  integral:
    - {signal: servo/output, weight: 0.1}
    - {signal: slide/friction + hinge/normal_force, weight: 0.01}
    - {signal: arm/velocity/z - arm/angular_velocity/y}
    - {signal: hinge/acceleration, weight: 0.02}
    - {signal: yaw/position + roll/velocity}
    - {signal: servo/integral}
  terminal: [{signal: servo/error}]
solver: {integrator: rosenbrock}
optimizer: {algorithm: lbfgs}
)";

class EquationsTest : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsTest() : EquationsFixture(kMechanism, kStudy) {}
};

TEST_F(EquationsTest, EveryDerivativeIsExact) { expect_exact_derivatives(1e-11); }

TEST_F(EquationsTest, ConstraintRowsAreTheSecondDerivativeOfPhi) {
  // Phi'' along (v, a) by differencing the rates, which the complex step does exactly: q + i h v, v
  // + i h a.
  using C = std::complex<double>;
  constexpr double h = 1e-30;
  VectorX<C> Phi, rates;
  State<C> moved;
  cast_state(state, &moved);
  moved.q += C(0.0, h) * state.v.cast<C>();
  moved.v += C(0.0, h) * state.z.head(system.layout().n).cast<C>();
  complex.constraint_errors(moved, &Phi, &rates);
  VectorX<double> G, errors, real_rates;
  double g = 0.0;
  real.residual(state, &G, &g);
  real.constraint_errors(state, &errors, &real_rates);
  EXPECT_LT((Phi.imag() / h - real_rates).norm(), 1e-12 * (1.0 + real_rates.norm()));
  EXPECT_LT((rates.imag() / h - G.segment(system.layout().n, system.layout().m)).norm(),
            1e-12 * (1.0 + G.norm()));
}

TEST_F(EquationsTest, FrictionIsTheForceOnTheChildAgainstItsMotion) {
  real.formulas().load(state);
  for (const JointLoad& load : system.loads()) {
    if (!load.find<BearingFriction>()) continue;
    const FrictionState<double> friction = real.formulas().friction(load.pair, load.element);
    EXPECT_GT(friction.load * friction.velocity, 0.0);
    EXPECT_GT(friction.normal, 0.0);
  }
}

TEST_F(EquationsTest, TerminalTermsHaveTheirGradient) {
  SparseGradient<double> gradient;
  const double w = real.terminal_gradient(state, &gradient);
  EXPECT_GE(w, 0.0);
  Eigen::VectorXd by_q = Eigen::VectorXd::Zero(system.layout().n);
  for (const auto& e : gradient.position)
    if (e.column < by_q.size()) by_q[e.column] += e.value;
  State<std::complex<double>> point;
  cast_state(state, &point);
  const Eigen::MatrixXd expected = complex_step_jacobian(
      [&](const Eigen::VectorXcd& q) {
        point.q = q;
        return Eigen::VectorXcd::Constant(1, complex.terminal(point));
      },
      state.q);
  EXPECT_LT(compare_jacobians(by_q.transpose(), expected).largest, 1e-12);
}

}  // namespace
}  // namespace codesign
