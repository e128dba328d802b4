// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Energies and powers, theory (14b), (14c): their derivatives, and that the rate of the energy is
// the sum of the powers.
#include <gtest/gtest.h>

#include "equations/equations_fixture.h"
#include "equations/formulas.h"
#include "equations/generic_state.h"
#include "equations/loaded_arm.h"
#include "math/differences.h"
#include "observation/energy.h"

namespace codesign {
namespace {

struct EnergyCase {
  std::string name, urdf, study;
};

void PrintTo(const EnergyCase& c, std::ostream* out) { *out << c.name; }

std::string study_of(const std::string& signals, const std::string& more = "") {
  return "duration: 1.0\nobjective: {integral: [" + signals + "]}\n" + more;
}

const char* const kEnergies =
    "{signal: mechanism/kinetic_energy, reference: 1.0}, {signal: mechanism/potential_energy}, "
    "{signal: mechanism/total_energy, weight: "
    "0.3}";
const char* const kPowers =
    "{signal: mechanism/friction_power, reference: 1.0}, {signal: mechanism/damping_power}, "
    "{signal: mechanism/actuator_power}, {signal: "
    "mechanism/load_power}";

const char* const kDriven =
    "limits: {position: true, effort: true, stiffness: 50.0, width: 0.01, dissipation: 0.4}\n"
    "controllers: {servo: {type: pid, input: elbow/position, output: elbow, setpoint: 0.4, gains: "
    "{p: 3.0, d: 0.2}}}\n"
    "loads: [{joint: shoulder, effort: 1.5}, {link: lower, force: [1.0, -2.0, 0.5], torque: [0.1, "
    "0.2, 0.3], point: [0.1, 0, -0.4]},\n"
    "        {link: upper, force: [0.4, 0.3, -1.0], torque: [0.3, -0.2, 0.1], point: [0, 0.2, "
    "0.1], frame: link}]\n";

std::vector<EnergyCase> cases() {
  return {{"Arm", loaded_arm(), kDriven},
          {"Puck", puck(), "loads: [{link: puck, force: [1.0, 0.0, 0.0]}]\n"},
          {"Ball", ball_pendulum(), "loads: [{joint: ball_y, effort: 0.4}]\n"},
          {"FourBarWithASpring", spring_pendulum(), ""}};
}

class EnergyConformance : public ::testing::TestWithParam<EnergyCase> {};

TEST_P(EnergyConformance, EnergiesAndPowersHaveExactDerivatives) {
  for (const char* signals : {kEnergies, kPowers}) {
    EquationsFixture e(GetParam().urdf, study_of(signals, GetParam().study));
    e.expect_exact_derivatives(1e-9);
  }
}

// Where no joint has moved, every decision has its recorded outcome, so the compiled code must run.
TEST_P(EnergyConformance, AreRecorded) {
  if (!ValueCode::is_available()) GTEST_SKIP() << "no machine code on this processor";
  for (const char* signals : {kEnergies, kPowers}) {
    EquationsFixture e(GetParam().urdf, study_of(signals, GetParam().study));
    e.state.q.setZero();
    for (int b = 0; b < e.system.layout().bodies; ++b) e.state.q[kBodySize * b + 3] = 1.0;
    e.expect_exact_residual();
  }
}

TEST_P(EnergyConformance, TheRateOfTheEnergyIsThePower) {
  Compiled c(GetParam().urdf, study_of(kEnergies, GetParam().study));
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  c.equations.formulas().load(c.state);
  const Energy energy = mechanical_energy(c.equations);
  const Power power = mechanical_power(&c.equations);
  // The derivative of the energy along (v, a).
  const auto energy_after = [&](double time) {
    State<double> moved = c.state;
    moved.q += time * c.state.v;
    moved.v += time * c.state.z.head(c.system.layout().n);
    c.equations.formulas().load(moved);
    const Energy after = mechanical_energy(c.equations);
    return after.kinetic + after.potential;
  };
  EXPECT_EQ(energy_after(0.0), energy.kinetic + energy.potential);
  const double rate = ridders_derivative(energy_after, 0.0, 1e-3).value;
  const double size = std::abs(power.friction) + std::abs(power.damping) +
                      std::abs(power.actuators) + std::abs(power.loads);
  EXPECT_NEAR(rate, power.total(), 1e-9 * (1.0 + size));
  EXPECT_LE(power.friction, 0.0);
  EXPECT_LE(power.damping, 0.0);
}

INSTANTIATE_TEST_SUITE_P(AllCases, EnergyConformance, ::testing::ValuesIn(cases()),
                         [](const auto& c) { return c.param.name; });

TEST(EnergySignals, OfTheJointsAddUp) {
  const auto value = [](const std::string& text) {
    EquationsFixture e(loaded_arm(), study_of(kEnergies, kDriven));
    const SignalDescription description = parse_signal(text, {}, "test");
    return e.real.formulas().signal(
        resolve_signal(description, e.robot, e.system.topology(), e.system.study().controllers),
        e.state);
  };
  for (const char* quantity : {"/friction_power", "/actuator_power"}) {
    const double all = value(std::string("mechanism") + quantity);
    EXPECT_NE(all, 0.0);
    EXPECT_NEAR(value(std::string("shoulder") + quantity) + value(std::string("elbow") + quantity),
                all, 1e-12 * std::abs(all));
  }
  EXPECT_LT(value("mechanism/damping_power - shoulder/damping_power - elbow/damping_power"), 0.0)
      << "the spring-damper's";
  EXPECT_NEAR(value("elbow/effort"), value("servo/output"), 0.1);
}

TEST(EnergySignals, OfAContactAndOfACylindricalLoop) {
  Compiled c(puck(), study_of("{signal: slope/friction_power}"));
  ASSERT_TRUE(c.start().ok());
  ASSERT_TRUE(scramble(&c));
  const Signal of_joint = resolve_signal(parse_signal("slope/friction_power", {}, "test"),
                                         c.system.robot(), c.system.topology(), {});
  const double power = c.equations.formulas().signal(of_joint, c.state);
  EXPECT_LT(power, 0.0);
  EXPECT_EQ(power, c.equations.formulas().power(PowerKind::kFriction));
}

}  // namespace
}  // namespace codesign
