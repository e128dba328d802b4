// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <regex>

#include "equations/equations_fixture.h"

namespace codesign {
namespace {

/// Friction with states on every pair that can have it: a prismatic joint that carries a ball, so that the ball's socket moves, a hinge, a
/// cylindrical loop, a table, a planar joint that also turns. `Gonthier` and `LuGre` alternate.
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
std::string mechanism(const std::string& gonthier = "gonthier", const std::string& lugre = "lugre") {
  const auto law = [](const std::string& model) {
    return "model=\"" + model + "\" mu_static=\"0.6\" mu_dynamic=\"0.4\" transition_velocity=\"1.2\"" +
           (model == "brown_mcphee" ? "" : " bristle_stiffness=\"3\" bristle_damping=\"0.2\"") +
           (model == "gonthier" ? " dwell_time=\"0.7\"" : "");
  };
  return std::regex_replace(std::regex_replace(std::string(kMechanism), std::regex("GONTHIER"), law(gonthier)), std::regex("LUGRE"),
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
  for (Eigen::Index k = 0; k < state.s.size(); ++k) state.s[k] = 0.05 + 0.02 * static_cast<double>(k % 3);
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
  // Both bodies of the ball turn at the same rate: in the ground's axes zeta turns with them and does not change otherwise.
  const auto ball = std::find_if(system.bristles().begin(), system.bristles().end(), [&](const BristleContact& c) {
    return system.topology().pairs[static_cast<std::size_t>(c.pair)].kind == PairKind::kSpherical;
  });
  ASSERT_NE(ball, system.bristles().end());
  const Pair& pair = system.topology().pairs[static_cast<std::size_t>(ball->pair)];
  const Eigen::Vector3d omega(0.3, -0.5, 0.8), zeta(0.1, 0.2, -0.1);
  for (int b : {pair.body_i, pair.body_j})
    state.v.segment<4>(kBodySize * b + 3) =
        0.5 * ground_rate_matrix<double>(Eigen::Vector4d(state.q.segment<4>(kBodySize * b + 3))).transpose() * omega;
  state.s.segment<3>(ball->first) = zeta;
  state.z.setZero();
  VectorX<double> G;
  double g = 0.0;
  real.residual(state, &G, &g);
  EXPECT_NEAR((-G.segment<3>(system.layout().state_column(ball->first)) - omega.cross(zeta)).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace codesign
