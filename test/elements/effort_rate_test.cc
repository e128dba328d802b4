// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The rate of efforts, theory (54), and the states of controllers, (50), (53): derivatives by state and time.
#include "elements/effort_rate.h"

#include <gtest/gtest.h>

#include "control/signal.h"
#include "equations/compiled.h"
#include "equations/equations_fixture.h"

namespace codesign {
namespace {

constexpr const char* kSwing = "{type: sine, amplitude: 0.7, period: 1.3, phase: 0.4}";

/// The derivatives of a double pendulum with one controller and of its signals. @param recorded as of expect_exact_derivatives(); that of
/// an anti-windup depends on the sign of the integral, and both are tried.
void expect_exact_rates(const std::string& controller, const std::string& terms, bool recorded = true) {
  SCOPED_TRACE(controller);
  const bool both = controller.find("antiwindup") != std::string::npos;
  for (const double outward : {1.0, -1.0}) {
    EquationsFixture fixture(double_pendulum(), "duration: 1.0\ngravity: [1.0, -2.0, -9.0]\ncontrollers:\n  a: {output: shoulder, " +
                                                    controller + "}\nobjective: {integral: [" + terms + "]}\n");
    fixture.state.t = 0.37;
    for (Eigen::Index k = 0; k < fixture.state.s.size(); ++k) fixture.state.s[k] = 0.1 + 0.05 * static_cast<double>(k);
    if (!both) return fixture.expect_exact_derivatives(1e-11, recorded);
    const Signal error = resolve_signal(parse_signal("a/error", {}, "signal"), fixture.system.robot(), fixture.system.topology(),
                                        fixture.system.study().controllers);
    fixture.state.s[0] = std::copysign(0.1, outward * fixture.real.formulas().signal(error, fixture.state));
    fixture.expect_exact_derivatives(1e-11, outward > 0.0);
  }
}

std::string pid(const std::string& keys, const std::string& input = "shoulder/position") {
  return "type: pid, input: " + input + ", setpoint: " + kSwing + ", " + keys;
}

TEST(ControllerStates, HaveExactDerivatives) {
  const std::string terms = "{signal: a/output + shoulder/effort}";
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative_filter: 0.02"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3"), terms);
  for (const char* sign : {"", "-"})
    expect_exact_rates(pid("gains: {p: 3.0, i: " + std::string(sign) + "2.0}, i_clamp: 0.3, antiwindup: true"), terms);
  for (const char* limit : {"40.0", "0.01"})
    expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, output_limit: " + std::string(limit) + ", time_constant: 0.01"), terms,
                       limit == std::string("40.0"));
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0, d: 0.5}, sample_time: 0.01, delay: 0.025, time_constant: 0.01, derivative_filter: 0.1"),
                     terms);
  expect_exact_rates("type: state_feedback, feedback: [{signal: elbow/position, gain: 2.0}], output_limit: 40.0, time_constant: 0.3",
                     terms);
}

TEST(EffortRate, HasExactDerivatives) {
  const std::string terms = "{signal: shoulder/effort_rate}";
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0, d: 0.5}"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative_filter: 0.02", "shoulder/velocity"), terms);
  for (const char* limit : {"40.0", "0.01"})
    expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3, output_limit: " + std::string(limit)), terms,
                       limit == std::string("40.0"));
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3, antiwindup: true"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, time_constant: 0.02"), terms);
  expect_exact_rates("type: state_feedback, feedforward: " + std::string(kSwing) +
                         ", feedback: [{signal: elbow/position, gain: 2.0, reference: " + kSwing + "}]",
                     terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, sample_time: 0.01, time_constant: 0.02"), terms);
}

TEST(EffortRate, IsTheSlopeOfTheEffort) {
  // The effort d (r' - x') + i s: the fixture's accelerations are given, so that the slope along (v, a, sigma, 1) is exact. Its positions
  // and velocities do not meet the constraints, so that the slope of an angle along v is not the joint's velocity: p has a test of its own.
  EquationsFixture fixture(double_pendulum(), "duration: 1.0\nlimits: {effort: true}\ncontrollers: {a: {output: shoulder, " +
                                                  pid("gains: {p: 0.0, i: 2.0, d: 0.5}, i_clamp: 0.6, output_limit: 20.0") +
                                                  "}}\nobjective: {integral: [{signal: shoulder/effort}]}\n");
  State<double> state = fixture.state;
  state.t = 0.37;
  state.s[0] = 0.2;
  Formulas<double>& formulas = fixture.real.formulas();
  const auto resolve = [&](const char* text) {
    return resolve_signal(parse_signal(text, {}, "signal"), fixture.system.robot(), fixture.system.topology(),
                          fixture.system.study().controllers);
  };
  SparseGradient<double> gradient;
  formulas.signal(resolve("shoulder/effort"), state, &gradient);
  const double error = formulas.signal(resolve("a/error"), state);
  double slope = gradient.time;
  const Layout& layout = fixture.system.layout();
  for (const auto& e : gradient.position) slope += e.value * (e.column < layout.n ? state.v[e.column] : error);
  for (const auto& e : gradient.velocity) slope += e.value * state.z[e.column];
  EXPECT_GT(std::abs(slope), 0.1);
  EXPECT_NEAR(formulas.signal(resolve("shoulder/effort_rate"), state), slope, 1e-12 * std::abs(slope));
}

TEST(EffortRate, OfAProportionalGainIsThatOfTheError) {
  EquationsFixture fixture(double_pendulum(), "duration: 1.0\ncontrollers: {a: {output: shoulder, " + pid("gains: {p: 3.0}") +
                                                  "}}\nobjective: {integral: [{signal: shoulder/effort}]}\n");
  State<double> state = fixture.state;
  state.t = 0.37;
  Formulas<double>& formulas = fixture.real.formulas();
  const auto value = [&](const char* text, SparseGradient<double>* gradient) {
    const Signal signal = resolve_signal(parse_signal(text, {}, "signal"), fixture.system.robot(), fixture.system.topology(),
                                         fixture.system.study().controllers);
    return formulas.signal(signal, state, gradient);
  };
  SparseGradient<double> of_effort;
  value("shoulder/effort", &of_effort);
  const double expected = of_effort.time - 3.0 * value("shoulder/velocity", nullptr);
  EXPECT_NEAR(value("shoulder/effort_rate", nullptr), expected, 1e-12 * std::abs(expected));
}

}  // namespace
}  // namespace codesign
