// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

#include "equations/compiled.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"

namespace codesign {
namespace {

std::string link(const std::string& name, const std::string& mass = "1") {
  return "<link name='" + name + "'><inertial><origin xyz='0.1 0.05 -0.2'/><mass value='" + mass +
         "'/><inertia ixx='0.02' ixy='0' ixz='0' iyy='0.018' iyz='0' "
         "izz='0.01'/></inertial></link>";
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& axis, const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><axis xyz='" + axis + "'/>" +
         (type == "prismatic" ? "<limit effort='1' velocity='1'/>" : "") + more + "</joint>";
}

std::string mimic(const std::string& other, const std::string& numbers) {
  return "<mimic joint='" + other + "' " + numbers + "/>";
}

/// Turns, slides on either side of a turn, the hinges of a universal and of a ball joint, each
/// coupled to another.
std::string geared_mechanism() {
  return robot(
      "<codesign:parameter name='m' value='0.7'/>" + link("cart") + link("arm", "0.7") +
      "<link name='fork'/>" + link("tip", "0.3") + "<link name='b1'/><link name='b2'/>" +
      link("ball", "0.4") + "<link name='stage'/>" + link("table") +
      joint("slide", "prismatic", "ground", "cart", "1 0 0") +
      joint("hinge", "continuous", "cart", "arm", "0 1 0",
            mimic("slide", "multiplier='0.7' codesign:multiplier='${m}' offset='0.2'")) +
      joint("yaw", "continuous", "arm", "fork", "0 0 1") +
      joint("roll", "continuous", "fork", "tip", "1 0.3 0", mimic("yaw", "multiplier='-1.5'")) +
      joint("ball_x", "continuous", "cart", "b1", "1 0 0", mimic("ball_y", "multiplier='2'")) +
      joint("ball_y", "continuous", "b1", "b2", "0 1 0") +
      joint("ball_z", "continuous", "b2", "ball", "0 0 1", mimic("hinge", "multiplier='0.3'")) +
      joint("table_x", "prismatic", "arm", "stage", "1 0 0") +
      joint("table_y", "prismatic", "stage", "table", "0.4 1 0",
            mimic("table_x", "multiplier='0.5'")) +
      "<coupling name='belt'><predecessor link='tip'/><successor link='table'/><ratio value='0.35' "
      "codesign:value='${m/2}'/></coupling>");
}

const char* const kGearStudy = "duration: 1.0\nobjective: {integral: [{signal: hinge/velocity}]}\n";

class EquationsCouplingsTest : public ::testing::Test, public EquationsFixture {
 protected:
  EquationsCouplingsTest() : EquationsFixture(geared_mechanism(), kGearStudy) {}
};

TEST_F(EquationsCouplingsTest, HasARowForEach) {
  EXPECT_EQ(system.layout().couplings, 6);
  // prismatic 5, revolute 5, universal 4, ball 3, table 4
  EXPECT_EQ(system.layout().m, 21 + 6 + 5);
  EXPECT_EQ(system.layout().pair_end(static_cast<int>(system.topology().pairs.size()) - 1), 21);
}

TEST_F(EquationsCouplingsTest, EveryDerivativeIsExact) { expect_exact_derivatives(1e-11); }

// Two flywheels about parallel axes, driven by a spring at the first. The second turns 20 times as
// fast, in the other direction.
std::string gear(const std::string& coupling) {
  const auto wheel = [](const std::string& name, const std::string& izz) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='" +
           izz + "'/></inertial></link>";
  };
  return robot(wheel("load", "0.8") + wheel("rotor", "0.001") +
               joint("out", "continuous", "ground", "load", "0 0 1",
                     "<codesign:torsion_spring stiffness='3' free_position='0.5'/>") +
               joint("motor", "continuous", "ground", "rotor", "0 0 1",
                     coupling == "mimic" ? mimic("out", "multiplier='-20' offset='0.4'") : "") +
               (coupling == "mimic" ? "" : coupling));
}

const char* const kPlus =
    "<coupling name='gear'><predecessor link='load'/><successor link='rotor'/><ratio "
    "value='-20'/></coupling>";

TEST(Couplings, AGearCarriesTheRotorsInertiaAndItsTooth) {
  for (const std::string& kind : {std::string("mimic"), std::string(kPlus)}) {
    Compiled c(gear(kind), let_go("{out: {position: 9.0, velocity: 2.0}}", "out/velocity"));
    ASSERT_TRUE(c.start().ok());
    const double inertia = 0.8 + 400.0 * 0.001, acceleration = -3.0 * (9.0 - 0.5) / inertia;
    c.equations.formulas().load(c.state);
    EXPECT_NEAR(c.equations.formulas().coordinate(0, 0).acceleration, acceleration,
                1e-12 * std::abs(acceleration));
    EXPECT_NEAR(c.equations.formulas().coordinate(1, 0).acceleration, -20.0 * acceleration,
                1e-12 * std::abs(20.0 * acceleration));
    // The rotor's own equation, 0.001 theta'' + lambda = 0.
    const double lambda =
        c.state.z[c.system.layout().lambda_column(c.system.layout().coupling_row(0))];
    EXPECT_NEAR(lambda, 0.02 * acceleration, 1e-12 * std::abs(acceleration));
  }
}

TEST(Couplings, TheFollowerStartsWhereItBelongsManyTurnsAway) {
  Compiled c(gear("mimic"), let_go("{out: {position: 9.0, velocity: 2.0}}", "out/velocity"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().coordinate(1, 0).position, -180.0 + 0.4, 1e-12);
  EXPECT_NEAR(c.equations.formulas().coordinate(1, 0).rate, -40.0, 1e-12);
  Eigen::VectorXd Phi, Phi_rate;
  c.equations.constraint_errors(c.state, &Phi, &Phi_rate);
  EXPECT_LT(Phi.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(Phi_rate.cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Couplings, GivenTheFollowerTheOthersAreSolvedFor) {
  Compiled c(gear("mimic"), let_go("{motor: {position: 100.4, velocity: 40.0}}", "out/velocity"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().coordinate(0, 0).position, -5.0, 1e-12);
  EXPECT_NEAR(c.equations.formulas().coordinate(0, 0).rate, -2.0, 1e-12);
}

TEST(Couplings, StartValuesThatContradictOneAreAStatusThatNamesIt) {
  Compiled c(gear(kPlus), let_go("{out: {position: 1.0}, motor: {position: 1.0}}", "out/velocity"));
  const Status status = c.start();
  EXPECT_EQ(status.code, StatusCode::kAssemblyFailed);
  EXPECT_NE(status.cause.find("'gear'"), std::string::npos) << status.cause;
}

TEST(Couplings, OfAChainWithoutAClosedFormKeepItsLinksAsBodies) {
  const std::string skew =
      robot("<link name='a'/><link name='b'/>" + link("ball") +
            joint("x", "continuous", "ground", "a", "1 0 0") +
            joint("y", "continuous", "a", "b", "0.5 1 0") +
            joint("z", "continuous", "b", "ball", "0 0 1", "\n" + mimic("x", "")));
  Compiled c(skew, let_go("{x: {position: 0.2, velocity: 1.0}}", "ball/position/x"));
  EXPECT_EQ(c.system.layout().bodies, 3);
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().coordinate(2, 0).rate,
              c.equations.formulas().coordinate(0, 0).rate, 1e-12);
}

}  // namespace

}  // namespace codesign
