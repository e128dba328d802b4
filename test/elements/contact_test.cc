// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <regex>

#include "equations/equations_fixture.h"

namespace codesign {
namespace {

/// A table, a ball folded from hinges, a planar joint with a turning contact, and a spherical loop, all with friction; loads on the
/// coordinates of the folded ball and of a universal joint.
const char* const kContactMechanism = R"(
<robot name="contacts" xmlns:codesign="urn:test"><link name="ground"/>
  <link name="cross"/>
  <link name="plate"><inertial><origin xyz="0.1 0 0.05"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <link name="ball_a"/><link name="ball_b"/>
  <link name="rod"><inertial><origin xyz="0 0.1 0.2" rpy="0.1 0.2 0.3"/><mass value="0.7"/>
    <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.018" iyz="0" izz="0.01"/></inertial></link>
  <link name="fork"/>
  <link name="tip"><inertial><mass value="0.3"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <link name="disc"><inertial><mass value="0.4"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.003"/></inertial></link>
  <joint name="table_x" type="prismatic"><parent link="ground"/><child link="cross"/><origin xyz="0 0 0.1" rpy="0.3 0 0"/><axis xyz="1 0 0"/>
    <limit effort="1" velocity="1"/></joint>
  <joint name="table_y" type="prismatic"><parent link="cross"/><child link="plate"/><axis xyz="0.5 1 0"/><limit effort="1" velocity="1"/>
    <dynamics damping="0.4" friction="0.2"/>
    <codesign:friction mu_static="0.4" mu_dynamic="0.3" transition_velocity="0.5" preload="0.2" viscous="0.1"/></joint>
  <joint name="ball_x" type="continuous"><parent link="plate"/><child link="ball_a"/><origin xyz="0.1 0 0" rpy="0.2 0 0"/><axis xyz="1 0 0"/>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.5" pin_radius="0.2" viscous="0.05"/>
    <dynamics damping="0.05"/></joint>
  <joint name="ball_y" type="continuous"><parent link="ball_a"/><child link="ball_b"/><axis xyz="0 1 0"/><dynamics damping="0.3" friction="0.1"/></joint>
  <joint name="ball_z" type="continuous"><parent link="ball_b"/><child link="rod"/><axis xyz="0 0 1"/>
    <codesign:torsion_spring stiffness="2" damping="0.1" free_position="0.2"/></joint>
  <joint name="yaw" type="continuous"><parent link="rod"/><child link="fork"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/>
    <codesign:torsion_spring stiffness="1.5"/></joint>
  <joint name="roll" type="continuous"><parent link="fork"/><child link="tip"/><axis xyz="1 0 0.3"/><dynamics damping="0.2"/></joint>
  <joint name="puck" type="planar"><parent link="ground"/><child link="disc"/><origin xyz="0 0.2 0" rpy="0 0.3 0"/><axis xyz="0 0 1"/>
    <codesign:friction mu_static="0.4" mu_dynamic="0.3" transition_velocity="0.5" pin_radius="0.3" viscous="0.1"/></joint>
  <loop name="socket" type="codesign:spherical"><predecessor link="disc"><origin xyz="0 0 0.4"/></predecessor>
    <successor link="tip"><origin xyz="0.1 0 0"/></successor>
    <codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.5" pin_radius="0.1"/></loop>
</robot>)";

const char* const kContactStudy = R"(
duration: 1.0
initial_state: {}
controllers:
  servo: {type: pid, input: ball_z/position - table_y/friction, setpoint: 0.3, output: ball_x, gains: {p: 3.0, i: 2.0}}
  wrist: {type: pid, input: roll/position, setpoint: 0.1, output: yaw, gains: {p: 1.0, d: 0.2}}
parameters: {}
objective:
  integral:
    - {signal: table_y/sliding_velocity - table_y/normal_force, weight: 0.1}
    - {signal: ball_x/friction + ball_x/sliding_velocity, weight: 0.2}
    - {signal: puck/friction - puck/normal_force, weight: 0.3}
    - {signal: socket/friction, reference: 0.4}
    - {signal: ball_y/friction}
solver: {integrator: rosenbrock}
optimizer: {algorithm: lbfgs}
)";

class EquationsContactsTest : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsContactsTest() : EquationsFixture(kContactMechanism, kContactStudy) {}
  int pair_of(const std::string& joint) const {
    for (std::size_t k = 0; k < robot.joints.size(); ++k)
      if (robot.joints[k].name == joint) return system.topology().joint_pair[k];
    return -1;
  }
};

TEST_F(EquationsContactsTest, EveryDerivativeIsExact) {
  ASSERT_EQ(system.contacts().size(), 4U);
  expect_exact_derivatives(1e-10);
  state.v *= 1e3;  // all contacts slip: the expected branches
  expect_exact_derivatives(1e-10);
}

TEST_F(EquationsContactsTest, EveryDerivativeIsExactAtRest) {
  state.v.setZero();
  // At rest the reported magnitudes, which the integrand reads, are not differentiable, so only the rows of G are compared.
  using S = State<std::complex<double>>;
  Linearization<double> d;
  d.resize(system.patterns());
  real.linearize(state, &d);
  const int rows = system.layout().columns() - system.layout().states;
  const auto top = [rows](const Eigen::MatrixXd& m) { return Eigen::MatrixXd(m.topRows(rows)); };
  for (const std::vector<double>* values : {&d.position, &d.velocity, &d.rate})
    for (double value : *values) ASSERT_TRUE(std::isfinite(value));
  const Eigen::MatrixXd by_q = dense(system.patterns().position, d.position).leftCols(system.layout().n);
  EXPECT_LT(compare_jacobians(top(by_q), top(reference(&S::q, state.q))).largest, 1e-10);
}

TEST_F(EquationsContactsTest, FrictionTakesPowerAndMatchesItsReports) {
  real.formulas().load(state);
  for (int pair : system.contacts()) {
    const ContactFriction<double> contact = real.formulas().contact(pair);
    EXPECT_GT(contact.power(), 0.0);
    EXPECT_GT(contact.normal, 0.0);
  }
  // A ball: |T| = r_e S(r_e |omega|) N + c |omega|, since slip and load are parallel.
  const ContactFriction<double> ball = real.formulas().contact(pair_of("ball_x"));
  const double S = friction_per_speed(std::pow(0.2 * ball.speed(), 2), 0.3, 0.2, 0.5) * 0.2 * ball.speed();
  EXPECT_NEAR(ball.magnitude(), 0.2 * S * ball.normal + 0.05 * ball.speed(), 1e-12);
  // A table: |F| = S(|v|) N + c |v|.
  const ContactFriction<double> table = real.formulas().contact(pair_of("table_y"));
  const double speed = table.speed();
  EXPECT_NEAR(table.magnitude(), friction_per_speed(speed * speed, 0.4, 0.3, 0.5) * speed * table.normal + 0.1 * speed, 1e-12);
}

TEST_F(EquationsContactsTest, ABallTurnsAtTheDifferenceOfTheAngularVelocities) {
  real.formulas().load(state);
  const Pair& pair = system.topology().pairs[static_cast<std::size_t>(pair_of("socket"))];
  const auto omega = [&](int index) {
    const BodyKinematics<double>& b = real.formulas().body(index);
    return Eigen::Vector3d(2.0 * ground_rate_matrix(b.p) * b.pd);
  };
  EXPECT_NEAR(real.formulas().contact(pair_of("socket")).speed(), (omega(pair.body_j) - omega(pair.body_i)).norm(), 1e-12);
}

std::string study_with(const std::string& controllers, const std::string& signal) {
  return "duration: 1.0\ninitial_state: {}\ncontrollers: " + controllers + "\nparameters: {}\nobjective: {integral: [{signal: " + signal +
         "}], terminal: []}\nsolver: {integrator: rosenbrock}\noptimizer: {algorithm: lbfgs}\n";
}

TEST(EquationsContacts, TheRateOfASlipIsNoSignal) {
  // A d gain would need the time derivative of a speed.
  EXPECT_THROW(
      EquationsFixture(kContactMechanism, study_with("{c: {type: pid, input: table_y/sliding_velocity, setpoint: 0.0, output: table_x, "
                                                     "gains: {d: 1.0}}}",
                                                     "table_x/position")),
      InputError);
}

TEST(EquationsContacts, HingesWithoutClosedFormAreRefused) {
  // Three hinges through one point, not at right angles: still folded into a ball, but the single hinges have no coordinates.
  const std::string skew = std::regex_replace(
      kContactMechanism, std::regex("<child link=\"ball_b\"/><axis xyz=\"0 1 0\"/><dynamics damping=\"0.3\" friction=\"0.1\"/>"),
      "<child link=\"ball_b\"/><axis xyz=\"0.5 1 0\"/>");
  ASSERT_NE(skew, kContactMechanism);
  EXPECT_THROW(EquationsFixture(skew, study_with("{}", "table_x/position")), InputError);  // because of the spring on ball_z
  const std::string passive =
      std::regex_replace(std::regex_replace(skew, std::regex("<codesign:torsion_spring[^>]*free_position[^>]*>"), ""),
                         std::regex("<dynamics damping=\"0.05\"/>"), "");
  EXPECT_NO_THROW(EquationsFixture(passive, study_with("{}", "table_x/position")));
  EXPECT_THROW(EquationsFixture(passive, study_with("{}", "ball_x/velocity")), InputError);
}

}  // namespace
}  // namespace codesign
