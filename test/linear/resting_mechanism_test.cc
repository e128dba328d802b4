// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/resting_mechanism.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "linear/equilibrium.h"
#include "mechanism_codesign/error.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

constexpr double kOhms = 0.5, kHenries = 0.01, kPerAmpere = 0.2;

/// A cart of 1 kg on a spring of 4 N/m, moved by a motor.
std::string motor(const std::string& inductance = R"( inductance="0.01")") {
  return carts(1,
               {sprung(4.0, 0.1) +
                R"(<codesign:actuator rotor_inertia="0" resistance="0.5" torque_constant="0.2")" +
                inductance + "/>"});
}

/// A PD of the position, whose output is the current that a PI of the voltage holds.
std::string cascade(const std::string& gains) {
  return controlled(
      "outer: {type: state_feedback, feedback: [{signal: x0/position, gain: 60, reference: 0.1}, "
      "{signal: x0/velocity, gain: 8}]}, inner: {type: pid, input: x0/current - outer/output, "
      "setpoint: 0, output: x0, gains: " +
      gains + "}");
}

// (L s + R + p + i/s)(s^2 + 0.1 s + 4)/K = -K s (back EMF) - (p + i/s)(60 + 8 s), times s.
TEST(RestingMechanism, AnInnerLoopOfTheCurrent) {
  const double p = 3.0;
  for (const double i : {200.0, 0.0}) {
    const LinearModel model =
        model_of(motor(), cascade("{p: 3" + (i > 0.0 ? std::string(", i: 200}") : "}")),
                 {"x0/current", "x0/position"});
    EXPECT_EQ(model.stability, Stability::kStable);
    for (const LinearMode& mode : model.modes) {
      const std::complex<double> s = mode.pole.value;
      const std::complex<double> cart = s * s + 0.1 * s + 4.0, law = p + i / s;
      const std::complex<double> sum = (kHenries * s + kOhms + law) * cart / kPerAmpere +
                                       kPerAmpere * s + law * (60.0 + 8.0 * s);
      const double size = std::abs(kHenries * s * cart / kPerAmpere) + std::abs(law * 60.0);
      EXPECT_LT(std::abs(sum), 1e-8 * size) << s;
    }
  }
}

// At rest K i = 4 x and i = 60 (0.1 - x).
TEST(RestingMechanism, CurrentsThatControllersRead) {
  const Problem problem = loaded(motor(), cascade("{p: 3, i: 200}"));
  const Equilibrium found = find_equilibrium(*system_of(problem), problem.parameters(), {});
  ASSERT_TRUE(found.status.ok()) << found.status.cause;
  const double x = 6.0 * kPerAmpere / (4.0 + 60.0 * kPerAmpere);
  EXPECT_NEAR(found.state.q[0], x, 1e-10);
  ASSERT_EQ(found.integrals.size(), 3U) << "two controllers, then the current";
  EXPECT_NEAR(found.integrals[2], 4.0 * x / kPerAmpere, 1e-8);
  EXPECT_NEAR(200.0 * found.integrals[1], kOhms * found.integrals[2], 1e-7) << "the voltage";
}

// Without an inductance it would be an algebraic loop.
TEST(RestingMechanism, ACurrentWithoutAStateIsRefused) {
  EXPECT_THROW(loaded(motor(""), cascade("{p: 3, i: 200}")), InputError);
  EXPECT_THROW(loaded(motor(), cascade("{p: 3, i: 200}") + "motion: {x0: {position: 0.1}}\n"),
               InputError);
}

}  // namespace
}  // namespace codesign
