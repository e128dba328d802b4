// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The rate of efforts, theory (54), and the states of controllers, (50), (53): derivatives by state
// and time.
#include "elements/effort_rate.h"

#include <gtest/gtest.h>

#include "assembly/assembly.h"
#include "control/signal.h"
#include "equations/compiled.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"

namespace codesign {
namespace {

constexpr const char* kSwing = "{type: sine, amplitude: 0.7, period: 1.3, phase: 0.4}";

/// The derivatives of a double pendulum with one controller and of its signals.
void expect_exact_rates(const std::string& controller, const std::string& terms) {
  SCOPED_TRACE(controller);
  for (const double sign : {1.0, -1.0}) {
    EquationsFixture fixture(
        double_pendulum(),
        "duration: 1.0\ngravity: [1.0, -2.0, -9.0]\ncontrollers:\n  a: {output: shoulder, " +
            controller + "}\nobjective: {integral: [" + terms + "]}\n");
    fixture.state.t = 0.37;
    for (Eigen::Index k = 0; k < fixture.state.s.size(); ++k)
      fixture.state.s[k] = sign * (0.1 + 0.05 * static_cast<double>(k));
    fixture.expect_exact_derivatives(1e-11);
  }
}

std::string pid(const std::string& keys, const std::string& input = "shoulder/position") {
  return "type: pid, input: " + input + ", setpoint: " + kSwing + ", " + keys;
}

TEST(ControllerStates, HaveExactDerivatives) {
  const std::string terms = "{signal: a/output + shoulder/effort}";
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative_filter: 0.02"), terms);
  for (const char* keys : {"", ", derivative_filter: 0.02", ", sample_time: 0.01"})
    expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative: measurement" + std::string(keys)),
                       terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3"), terms);
  for (const char* sign : {"", "-"})
    expect_exact_rates(
        pid("gains: {p: 3.0, i: " + std::string(sign) + "2.0}, i_clamp: 0.3, antiwindup: true"),
        terms);
  for (const char* limit : {"40.0", "0.01"})
    expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, output_limit: " + std::string(limit) +
                           ", time_constant: 0.01"),
                       terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0, d: 0.5}, sample_time: 0.01, delay: 0.025, "
                         "time_constant: 0.01, derivative_filter: 0.1"),
                     terms);
  expect_exact_rates(
      "type: state_feedback, feedback: [{signal: elbow/position, gain: 2.0}], output_limit: 40.0, "
      "time_constant: 0.3",
      terms);
}

const std::string kNotch = "{type: notch, frequency: 3.0, damping: 0.4, depth: 0.1}";
const std::string kLag = "{type: lead_lag, zero: 5.0, pole: 0.7}";

TEST(ControllerStates, OfFiltersAndAntiWindupHaveExactDerivatives) {
  const std::string terms = "{signal: a/output + shoulder/effort}";
  for (const std::string& filter :
       {kNotch, "[" + kNotch + ", " + kLag + ", {type: low_pass_2, frequency: 2.0}]"}) {
    const std::string keys = "gains: {p: 3.0, i: 2.0, d: 0.5}, filter: " + filter;
    for (const char* more : {"", ", derivative: measurement", ", derivative_filter: 0.02",
                             ", sample_time: 0.01, delay: 0.025"})
      expect_exact_rates(pid(keys + more), terms);
    expect_exact_rates("type: pd_gravity, gains: {p: 3.0, d: 0.5}, setpoint: " +
                           std::string(kSwing) + ", filter: " + filter,
                       terms);
    expect_exact_rates(
        "type: state_feedback, feedback: [{signal: elbow/position, gain: 2.0, filter: " + filter +
            "}, {signal: shoulder/velocity, gain: 0.3}]",
        terms);
  }
  for (const char* limit : {"40.0", "0.01", "[-0.2, 5.0]"})
    for (const char* method :
         {"back_calculation", "back_calculation, tracking_time: 0.3", "conditional"})
      for (const char* sign : {"", "-"})
        expect_exact_rates(pid("gains: {p: " + std::string(sign) + "3.0, i: " + sign +
                               "2.0}, output_limit: " + limit + ", antiwindup: " + method),
                           terms);
}

TEST(EffortRate, BehindFiltersAndLimitsHasExactDerivatives) {
  const std::string terms = "{signal: shoulder/effort_rate}";
  const std::string filters = ", filter: [" + kNotch + ", " + kLag + "]";
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}" + filters), terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative_filter: 0.02" + filters), terms);
  expect_exact_rates(
      pid("gains: {p: 3.0, i: 2.0}, output_limit: [-0.2, 9.0], antiwindup: back_calculation"),
      terms);
  expect_exact_rates(
      "type: state_feedback, feedback: [{signal: elbow/position, gain: 2.0" + filters + "}]",
      terms);
}

TEST(EffortRate, HasExactDerivatives) {
  const std::string terms = "{signal: shoulder/effort_rate}";
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0, d: 0.5}"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, derivative_filter: 0.02", "shoulder/velocity"),
                     terms);
  for (const char* keys : {"", ", derivative_filter: 0.02"})
    expect_exact_rates(
        pid("gains: {p: 3.0, i: 2.0, d: 0.5}, derivative: measurement" + std::string(keys)), terms);
  for (const char* limit : {"40.0", "0.01"})
    expect_exact_rates(
        pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3, output_limit: " + std::string(limit)), terms);
  expect_exact_rates(pid("gains: {p: 3.0, i: 2.0}, i_clamp: 0.3, antiwindup: true"), terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, time_constant: 0.02"), terms);
  expect_exact_rates("type: state_feedback, feedforward: " + std::string(kSwing) +
                         ", feedback: [{signal: elbow/position, gain: 2.0, reference: " + kSwing +
                         "}]",
                     terms);
  expect_exact_rates(pid("gains: {p: 3.0, d: 0.5}, sample_time: 0.01, time_constant: 0.02"), terms);
}

TEST(EffortRate, IsTheSlopeOfTheEffort) {
  // At a state that satisfies the constraints, along which (q, v, s)' = (v, a, sigma).
  const RobotDescription robot = read_urdf({"test.urdf", double_pendulum()});
  const std::string text =
      "duration: 1.0\ninitial_state: {shoulder: {position: 0.5, velocity: 0.7}, elbow: {velocity: "
      "-1.1}}\ncontrollers: {a: {output: "
      "shoulder, " +
      pid("gains: {p: 3.0, i: 2.0, d: 0.5}, i_clamp: 0.6, output_limit: 3.0") +
      "}}\nobjective: {terminal: [{signal: shoulder/effort}]}\n";
  const CompiledSystem system(robot, read_study({"test.yaml", text}, robot));
  Equations<double> equations(system);
  Assembly assembly(system);
  State<double> state;
  state.resize(system.layout());
  equations.set_design(system.parameters());
  ASSERT_TRUE(assembly.solve(system.parameters(), &equations, &state).ok());
  state.s[0] = 0.2;
  ASSERT_TRUE(assembly.rates().solve(&equations, &state).ok());
  Formulas<double>& formulas = equations.formulas();
  const auto resolve = [&](const char* signal) {
    return resolve_signal(parse_signal(signal, {}, "signal"), system.robot(), system.topology(),
                          system.study().controllers);
  };
  // The terminal term is the square of the effort. The effort reads no accelerations, whose rates
  // would be missing.
  SparseGradient<double> gradient;
  equations.terminal_gradient(state, &gradient);
  ASSERT_TRUE(gradient.rate.empty());
  double slope = gradient.time;
  const Layout& layout = system.layout();
  for (const auto& e : gradient.position)
    slope += e.value * (e.column < layout.n ? state.v[e.column]
                                            : state.z[layout.state_column(e.column - layout.n)]);
  for (const auto& e : gradient.velocity) slope += e.value * state.z[e.column];
  slope /= 2.0 * formulas.signal(resolve("shoulder/effort"), state);
  EXPECT_GT(std::abs(slope), 0.1);
  EXPECT_NEAR(formulas.signal(resolve("shoulder/effort_rate"), state), slope,
              1e-11 * std::abs(slope));
}

}  // namespace
}  // namespace codesign
