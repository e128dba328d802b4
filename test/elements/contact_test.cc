// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include "edited_text.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "forces/bristles.h"
#include "mechanism/topology.h"

namespace codesign {
namespace {

/// Friction with states on every pair that can have it: a prismatic joint that carries a ball, so
/// that the ball's socket moves, a hinge, a cylindrical loop, a table, a planar joint that also
/// turns. `Gonthier` and `LuGre` alternate.
const char* const kMechanism = R"(
<robot name="bristles" xmlns:codesign="urn:test"><link name="ground"/>
  <link name="cart"><inertial><origin xyz="0.1 0 0.05"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0 0.1 0.2" rpy="0.1 0.2 0.3"/><mass value="0.7"/>
    <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.018" iyz="0" izz="0.01"/></inertial></link>
  <link name="a"/><link name="b"/>
  <link name="tip"><inertial><mass value="0.3"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <link name="disc"><inertial><mass value="0.4"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.003"/></inertial></link>
  <link name="cross"/>
  <link name="plate"><inertial><mass value="0.5"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.003"/></inertial></link>
  <joint name="rail" type="prismatic"><parent link="ground"/><child link="cart"/><origin xyz="0 0 0.1" rpy="0.3 0 0"/><axis xyz="1 0 0"/>
    <limit effort="1" velocity="1"/><codesign:friction GONTHIER joint_length="0.2" joint_width="0.1" viscous="0.1"/></joint>
  <joint name="hinge" type="continuous"><parent link="cart"/><child link="arm"/><axis xyz="0 1 0"/>
    <codesign:friction LUGRE joint_length="0.2" pin_radius="0.4" preload="0.3"/></joint>
  <joint name="ball_x" type="continuous"><parent link="arm"/><child link="a"/><origin xyz="0.1 0 0.3" rpy="0.2 0 0"/><axis xyz="1 0 0"/>
    <codesign:friction GONTHIER pin_radius="0.2" viscous="0.05"/></joint>
  <joint name="ball_y" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
  <joint name="ball_z" type="continuous"><parent link="b"/><child link="tip"/><axis xyz="0 0 1"/></joint>
  <joint name="puck" type="planar"><parent link="arm"/><child link="disc"/><origin xyz="0 0.2 0" rpy="0 0.3 0"/><axis xyz="0 0 1"/>
    <codesign:friction LUGRE pin_radius="0.3" viscous="0.1"/></joint>
  <joint name="table_x" type="prismatic"><parent link="disc"/><child link="cross"/><axis xyz="1 0 0"/><limit effort="1" velocity="1"/>
    <codesign:friction GONTHIER/></joint>
  <joint name="table_y" type="prismatic"><parent link="cross"/><child link="plate"/><axis xyz="0 1 0"/><limit effort="1" velocity="1"/></joint>
  <loop name="sleeve" type="codesign:cylindrical"><predecessor link="disc"><origin xyz="0 0 0.4"/></predecessor>
    <successor link="tip"><origin xyz="0.1 0 0"/></successor><axis xyz="0 1 0"/>
    <codesign:friction LUGRE joint_length="0.3" pin_radius="0.5"/></loop>
</robot>)";

/// Transition velocity and stiffness for which all terms matter at states and speeds of order one.
std::string mechanism(const std::string& gonthier = "gonthier",
                      const std::string& lugre = "lugre") {
  const auto law = [](const std::string& model) {
    return "model=\"" + model +
           "\" mu_static=\"0.6\" mu_dynamic=\"0.4\" transition_velocity=\"1.2\"" +
           (model == "brown_mcphee" ? "" : " bristle_stiffness=\"3\" bristle_damping=\"0.2\"") +
           (model == "gonthier" ? " dwell_time=\"0.7\"" : "");
  };
  return replaced_all(replaced_all(std::string(kMechanism), "GONTHIER", law(gonthier)), "LUGRE",
                      law(lugre));
}

const char* const kStudy = R"(
duration: 1.0
initial_state: {}
controllers:
  servo: {type: pid, input: hinge/position - rail/friction, setpoint: 0.3, output: rail, gains: {p: 3.0, i: 2.0}}
parameters: {}
objective:
  integral:
    - {signal: rail/friction + hinge/friction, weight: 0.1}
    - {signal: ball_x/friction - puck/friction, weight: 0.2}
    - {signal: table_x/friction, weight: 0.3}
solver: {integrator: rosenbrock}
optimizer: {algorithm: lbfgs}
)";

class EquationsBristlesTest : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsBristlesTest() : EquationsFixture(mechanism(), kStudy) {}
};

TEST_F(EquationsBristlesTest, StatesStandBehindTheControllers) {
  // The servo's integral 1; rail 1 + 1, hinge 1, sleeve 1 + 1; ball 3 + 1, puck 3, table 2 + 1.
  EXPECT_EQ(system.layout().states, 1 + 2 + 1 + 2 + 4 + 3 + 3);
  int next = 1;
  for (const BristleContact& contact : system.bristles()) {
    EXPECT_EQ(contact.first, next);
    next += contact.states();
  }
  EXPECT_EQ(next, system.layout().states);
  EXPECT_EQ(system.bristle(0, 7), nullptr);
}

TEST_F(EquationsBristlesTest, EveryDerivativeIsExact) {
  expect_exact_derivatives(1e-9);
  // Deflections so small that no friction reaches its bound F, theory (13e).
  for (Eigen::Index k = 0; k < state.s.size(); ++k)
    state.s[k] = 0.05 + 0.02 * static_cast<double>(k % 3);
  state.v *= 0.1;
  expect_exact_derivatives(1e-9);
  // Sliding with full dwell states: the expected branches.
  state.v *= 50.0;
  for (const BristleContact& contact : system.bristles())
    if (contact.dwells()) state.s[contact.dwell_state()] = 0.999;
  expect_exact_derivatives(1e-9);
}

TEST(EquationsBristles, WithoutStatesTheLawIsBrownAndMcPhees) {
  EquationsFixture plain(mechanism("brown_mcphee", "brown_mcphee"), kStudy);
  EXPECT_EQ(plain.system.layout().states, 1);
  EXPECT_TRUE(plain.system.bristles().empty());
}

TEST_F(EquationsBristlesTest, AContactThatTurnsAsOneKeepsItsDeflection) {
  // Both bodies of the ball turn at the same rate: in the ground's axes zeta turns with them and
  // does not change otherwise.
  const auto ball = std::find_if(
      system.bristles().begin(), system.bristles().end(), [&](const BristleContact& c) {
        return system.topology().pairs[static_cast<std::size_t>(c.pair)].kind ==
               PairKind::kSpherical;
      });
  ASSERT_NE(ball, system.bristles().end());
  const Pair& pair = system.topology().pairs[static_cast<std::size_t>(ball->pair)];
  const Eigen::Vector3d omega(0.3, -0.5, 0.8), zeta(0.1, 0.2, -0.1);
  for (int b : {pair.body_i, pair.body_j})
    state.v.segment<4>(kBodySize * b + 3) =
        0.5 *
        ground_rate_matrix<double>(Eigen::Vector4d(state.q.segment<4>(kBodySize * b + 3)))
            .transpose() *
        omega;
  state.s.segment<3>(ball->first) = zeta;
  state.z.setZero();
  VectorX<double> G;
  double g = 0.0;
  real.residual(state, &G, &g);
  EXPECT_NEAR((-G.segment<3>(system.layout().state_column(ball->first)) - omega.cross(zeta)).norm(),
              0.0, 1e-14);
}

/// A table, a ball folded from hinges, a planar joint with a turning contact, and a spherical loop,
/// all with friction; loads on the coordinates of the folded ball and of a universal joint.
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
  // At rest the reported magnitudes, which the integrand reads, are not differentiable, so only the
  // rows of G are compared.
  using S = State<std::complex<double>>;
  Linearization<double> d;
  d.resize(system.patterns());
  real.linearize(state, &d);
  const int rows = system.layout().columns() - system.layout().states;
  const auto top = [rows](const Eigen::MatrixXd& m) { return Eigen::MatrixXd(m.topRows(rows)); };
  for (const std::vector<double>* values : {&d.position, &d.velocity, &d.rate})
    for (double value : *values) ASSERT_TRUE(std::isfinite(value));
  const Eigen::MatrixXd by_q =
      dense(system.patterns().position, d.position).leftCols(system.layout().n);
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
  const double S =
      friction_per_speed(std::pow(0.2 * ball.speed(), 2), 0.3, 0.2, 0.5) * 0.2 * ball.speed();
  EXPECT_NEAR(ball.magnitude(), 0.2 * S * ball.normal + 0.05 * ball.speed(), 1e-12);
  // A table: |F| = S(|v|) N + c |v|.
  const ContactFriction<double> table = real.formulas().contact(pair_of("table_y"));
  const double speed = table.speed();
  EXPECT_NEAR(table.magnitude(),
              friction_per_speed(speed * speed, 0.4, 0.3, 0.5) * speed * table.normal + 0.1 * speed,
              1e-12);
}

TEST_F(EquationsContactsTest, ABallTurnsAtTheDifferenceOfTheAngularVelocities) {
  real.formulas().load(state);
  const Pair& pair = system.topology().pairs[static_cast<std::size_t>(pair_of("socket"))];
  const auto omega = [&](int index) {
    const BodyKinematics<double>& b = real.formulas().body(index);
    return Eigen::Vector3d(2.0 * ground_rate_matrix(b.p) * b.pd);
  };
  EXPECT_NEAR(real.formulas().contact(pair_of("socket")).speed(),
              (omega(pair.body_j) - omega(pair.body_i)).norm(), 1e-12);
}

std::string study_with(const std::string& controllers, const std::string& signal) {
  return "duration: 1.0\ninitial_state: {}\ncontrollers: " + controllers +
         "\nparameters: {}\nobjective: {integral: [{signal: " + signal +
         "}], terminal: []}\nsolver: {integrator: rosenbrock}\noptimizer: {algorithm: lbfgs}\n";
}

TEST(EquationsContacts, TheRateOfASlipIsNoSignal) {
  // A d gain would need the time derivative of a speed.
  EXPECT_THROW(
      EquationsFixture(
          kContactMechanism,
          study_with(
              "{c: {type: pid, input: table_y/sliding_velocity, setpoint: 0.0, output: table_x, "
              "gains: {d: 1.0}}}",
              "table_x/position")),
      InputError);
}

TEST(EquationsContacts, HingesWithoutClosedFormAreRefused) {
  // Three hinges through one point, not at right angles: still folded into a ball, but the single
  // hinges have no coordinates.
  const std::string skew = replaced_all(kContactMechanism,
                                        "<child link=\"ball_b\"/><axis xyz=\"0 1 0\"/><dynamics "
                                        "damping=\"0.3\" friction=\"0.1\"/>",
                                        "<child link=\"ball_b\"/><axis xyz=\"0.5 1 0\"/>");
  ASSERT_NE(skew, kContactMechanism);
  EXPECT_THROW(EquationsFixture(skew, study_with("{}", "table_x/position")),
               InputError);  // because of the spring on ball_z
  const std::string passive =
      replaced_all(replaced_all(skew, "<codesign:torsion_spring[^>]*free_position[^>]*>", ""),
                   "<dynamics damping=\"0.05\"/>", "");
  EXPECT_NO_THROW(EquationsFixture(passive, study_with("{}", "table_x/position")));
  EXPECT_THROW(EquationsFixture(passive, study_with("{}", "ball_x/velocity")), InputError);
}

}  // namespace

}  // namespace codesign
