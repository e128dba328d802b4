// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/rest_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "description/linear_measure.h"
#include "description/tuned_parameters.h"
#include "math/differences.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

const char* const kOfPoles =
    "  - {poles: growth, at_most: 100}\n  - {poles: damping_ratio, at_least: 0}\n";

/// Bounds on all measures of a loop, and of poles.
std::string bounds(const std::string& loop, const std::vector<std::string>& measures,
                   const std::string& of_poles = kOfPoles) {
  std::string text = "constraints:\n" + of_poles;
  for (const std::string& measure : measures)
    text += "  - {loop: " + loop + ", measure: " + measure + ", at_least: 0}\n";
  return text;
}

std::string tuned(const std::vector<std::pair<std::string, double>>& parameters) {
  std::string text = "parameters:\n";
  for (const auto& [name, value] : parameters)
    text += "  " + name + ": {initial: " + std::to_string(value) + ", lower: 0.001, upper: 1000}\n";
  return text;
}

/// Compares the derivatives of all numbers with Ridders' differences of their values. @param places
/// of poles that are compared: those beyond may be the last one again.
void expect_derivatives(const std::string& urdf, const std::string& study, double tolerance = 1e-7,
                        Eigen::Index places = LinearMeasure::kPoles) {
  const Problem problem = loaded(urdf, study);
  const CompiledSystem& system = *system_of(problem);
  RestNumbers numbers(system);
  const std::vector<double> parameters = problem.parameters();
  const Status status = numbers.evaluate(parameters, true, nullptr);
  ASSERT_TRUE(status.ok()) << status.cause;
  const std::vector<RestNumbers::Entry> exact = numbers.entries();
  ASSERT_FALSE(exact.empty());
  const std::vector<int>& tuned = system.study().tuned;
  // All numbers at the same moved parameters belong to one evaluation.
  std::map<std::pair<int, double>, std::vector<RestNumbers::Entry>> moved_entries;
  const auto moved_by = [&](int parameter, double step) -> const std::vector<RestNumbers::Entry>& {
    std::vector<RestNumbers::Entry>& entries = moved_entries[{parameter, step}];
    if (!entries.empty()) return entries;
    std::vector<double> moved = parameters;
    moved[static_cast<std::size_t>(parameter)] += step;
    const Status at = numbers.evaluate(moved, false, nullptr);
    EXPECT_TRUE(at.ok()) << at.cause;
    return entries = numbers.entries();
  };
  for (std::size_t entry = 0; entry < exact.size(); ++entry)
    for (std::size_t p = 0; p < tuned.size(); ++p)
      for (Eigen::Index k = 0; k < std::min(places, exact[entry].values.size()); ++k) {
        const auto value = [&](double step) { return moved_by(tuned[p], step)[entry].values[k]; };
        // A crossing far from deciding is small beside what rounding leaves of it.
        if (std::abs(exact[entry].values[k]) > 100.0 * std::abs(exact[entry].values[0]) + 1.0)
          continue;
        const double start = parameters[static_cast<std::size_t>(tuned[p])];
        const RiddersDerivative reference = ridders_derivative(value, 0.0, 1e-2 * start);
        const double size = std::abs(reference.value) + std::abs(exact[entry].values[k] / start);
        EXPECT_NEAR(exact[entry].gradients(static_cast<Eigen::Index>(p), k), reference.value,
                    tolerance * size + 10.0 * reference.error)
            << system.whole_study().watched[entry].signal.text << ", place " << k << ", by "
            << tuned_parameter(system.study(), static_cast<Eigen::Index>(p)).name;
        EXPECT_LT(reference.error, 10.0 * tolerance * size + 1e-9)
            << "a reference that is none: " << system.whole_study().watched[entry].signal.text
            << ", place " << k << ", by "
            << tuned_parameter(system.study(), static_cast<Eigen::Index>(p)).name << ": "
            << reference.value << " for "
            << exact[entry].gradients(static_cast<Eigen::Index>(p), k);
      }
}

TEST(RestNumbers, OfACartByClosedForms) {
  // s^2 + d s + p of a cart of 1 kg: p = 4, d = 1.
  const Problem problem =
      loaded(carts(1, {""}), tuned({{"p", 4.0}, {"d", 1.0}}) +
                                 controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}")) +
                                 bounds("servo0", {"bandwidth"}));
  RestNumbers numbers(*system_of(problem));
  ASSERT_TRUE(numbers.evaluate(problem.parameters(), true, nullptr).ok());
  const RestNumbers::Entry growth = numbers.entries()[0], damping = numbers.entries()[1];
  EXPECT_NEAR(growth.values[0], -0.5, 1e-12);
  EXPECT_NEAR(growth.values[1], -0.5, 1e-12) << "a pair counts twice";
  EXPECT_NEAR(growth.gradients(0, 0), 0.0, 1e-12);
  EXPECT_NEAR(growth.gradients(1, 0), -0.5, 1e-12);
  EXPECT_NEAR(damping.values[0], 0.25, 1e-12);
  EXPECT_NEAR(damping.gradients(0, 0), -0.25 / 8.0, 1e-12);
  EXPECT_NEAR(damping.gradients(1, 0), 0.25, 1e-12);
}

TEST(RestNumbers, OfALoopWithAnIntegralAndALag) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"p", 6.0}, {"i", 2.0}, {"d", 3.0}, {"tau", 0.05}}) +
          controlled(cart_servo("gains: {p: \"${p}\", i: \"${i}\", d: \"${d}\"}, time_constant: "
                                "\"${tau}\", derivative_filter: 0.02")) +
          bounds("servo0", {"gain_margin", "phase_margin", "delay_margin", "bandwidth",
                            "sensitivity", "complementary_sensitivity"}),
      1e-7, 5);
}

const char* const kPendulum =
    R"(<robot name="arm" xmlns:codesign="urn:mechanism_codesign">
<codesign:parameter name="l" value="0.5" lower="0.1" upper="1"/><link name="base"/><link name="bar"><inertial><origin xyz="0 0 -0.5" codesign:xyz="0 0 ${-l}"/><mass value="2"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="bar"/><axis xyz="0 1 0"/>
<dynamics damping="0.1"/></joint></robot>)";

// The droop of the arm below its set-point moves with everything.
TEST(RestNumbers, ThroughThePostureAtRest) {
  expect_derivatives(
      kPendulum,
      tuned({{"p", 30.0}, {"top", 1.0}}) + "  l: {}\n  d: {initial: 2.0}\n" +
          "duration: 10\ncontrollers: {servo: {type: pid, input: hinge/position, setpoint: "
          "\"${2*top}\", output: hinge, gains: {p: \"${p}\", d: \"${d}\"}, time_constant: 0.05, "
          "derivative_filter: 0.03}}\n" +
          bounds("servo",
                 {"phase_margin", "sensitivity", "bandwidth", "gain_margin", "gain_reduction"}),
      1e-7, 3);
}

// The rod's loop turns the free direction of the coordinates, and an integral holds the slider.
TEST(RestNumbers, OfAClosedLoopOfBodies) {
  expect_derivatives(
      planar_slider_crank(),
      tuned({{"at", 0.33}, {"p", 300.0}, {"i", 200.0}, {"d", 20.0}}) +
          "duration: 10\ninitial_state: {slider_joint: {position: \"${at}\"}, crank_joint: {guess: "
          "0.9}}\ncontrollers: {servo: {type: pid, input: slider_joint/position, setpoint: "
          "\"${at}\", output: crank_joint, gains: {p: \"${-p}\", i: \"${-i}\", d: \"${-d}\"}, "
          "derivative_filter: 0.01}}\n" +
          bounds("servo", {"sensitivity", "complementary_sensitivity", "bandwidth"}),
      1e-7, 1);
}

const std::vector<std::string> kSampledMeasures{"gain_margin",  "phase_margin",
                                                "delay_margin", "bandwidth",
                                                "sensitivity",  "complementary_sensitivity"};
const std::string kSampledPoles = std::string(kOfPoles) + "  - {poles: radius, at_most: 2}\n";

TEST(RestNumbers, OfASampledLoopWithFilterDelayAndLag) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"p", 6.0}, {"i", 2.0}, {"d", 3.0}, {"tau", 0.05}, {"filter", 0.03}}) +
          controlled(cart_servo("gains: {p: \"${p}\", i: \"${i}\", d: \"${d}\"}, time_constant: "
                                "\"${tau}\", derivative_filter: \"${filter}\", sample_time: 0.02, "
                                "delay: 0.03, i_clamp: 50, output_limit: 60")) +
          bounds("servo0", kSampledMeasures, kSampledPoles),
      1e-7, 4);
}

// The posture moves, the derivative is that of the measurement alone.
TEST(RestNumbers, OfASampledServoThroughThePosture) {
  expect_derivatives(
      kPendulum,
      tuned({{"p", 30.0}, {"top", 1.0}}) + "  l: {}\n  d: {initial: 2.0}\n" +
          "duration: 10\ncontrollers: {servo: {type: pid, input: hinge/position, setpoint: "
          "\"${2*top}\", output: hinge, derivative: measurement, sample_time: 0.01, gains: {p: "
          "\"${p}\", d: \"${d}\"}}}\n" +
          bounds("servo", kSampledMeasures, kSampledPoles),
      1e-7, 2);
}

// A cascade whose inner loop samples more often, and laws that are no PID.
TEST(RestNumbers, OfSampledCascadesAndOtherLaws) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"Kv", 3.0}, {"Kp", 8.0}}) +
          controlled("outer: {type: pid, input: x0/position, setpoint: 0.2, gains: {p: \"${Kv}\"}, "
                     "sample_time: 0.02}, inner: {type: pid, input: x0/velocity - outer/output, "
                     "setpoint: 0, output: x0, gains: {p: \"${Kp}\"}, sample_time: 0.01}") +
          "constraints:\n" + kSampledPoles,
      1e-7, 2);
  for (const char* const law :
       {"type: computed_torque, setpoint: 0.7, gains: {p: \"${p}\", d: \"${d}\"}",
        "type: pd_gravity, setpoint: 0.7, gains: {p: \"${p}\", d: \"${d}\"}",
        "type: state_feedback, feedforward: \"${p*0.1}\", feedback: [{signal: hinge/position, "
        "gain: "
        "\"${p}\", reference: 0.7}, {signal: \"${sin(hinge/velocity)}\", gain: \"${d}\"}]"})
    expect_derivatives(
        kPendulum,
        tuned({{"p", 30.0}, {"d", 3.0}}) + "  l: {}\n" +
            "duration: 10\ncontrollers: {servo: {output: hinge, sample_time: 0.01, " + law +
            "}}\n" + bounds("servo", kSampledMeasures, kSampledPoles),
        1e-7, 2);
}

// The inner loop samples three times in the common period, in which the outer one reads it once.
TEST(RestNumbers, OfLoopsOfSeveralSampleTimes) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"Kv", 3.0}, {"Kp", 8.0}, {"Ki", 2.0}, {"tau", 0.03}}) +
          controlled("outer: {type: pid, input: x0/position, setpoint: 0.2, gains: {p: \"${Kv}\"}, "
                     "sample_time: 0.15}, inner: {type: pid, input: x0/velocity - outer/output, "
                     "setpoint: 0, output: x0, gains: {p: \"${Kp}\", i: \"${Ki}\"}, sample_time: "
                     "0.05, time_constant: \"${tau}\"}") +
          bounds("inner", kSampledMeasures, kSampledPoles),
      1e-7, 1);
}

// A continuous loop with a lag beside a sampled one with a delay, which reads what it moves; at a
// posture that moves, and of a loop without lag.
TEST(RestNumbers, OfContinuousLoopsBesideSampledOnes) {
  const std::string sampled =
      ", damper: {type: pid, input: x0/velocity, setpoint: 0, output: x0, gains: {p: \"${Kd}\"}, "
      "sample_time: 0.1, delay: 0.05}";
  expect_derivatives(
      carts(1, {sprung(4.0, 0.5)}),
      tuned({{"Kp", 20.0}, {"Kd", 6.0}, {"tau", 0.05}, {"top", 0.3}}) +
          controlled("servo: {type: pid, input: x0/position, setpoint: \"${top}\", output: x0, "
                     "gains: {p: \"${Kp}\", d: 1}, time_constant: \"${tau}\"}" +
                     sampled) +
          bounds("servo", kSampledMeasures, kSampledPoles),
      1e-7, 1);
  expect_derivatives(carts(1, {damped(1.0)}),
                     tuned({{"Kp", 20.0}, {"Kd", 6.0}}) +
                         controlled(cart_servo("gains: {p: \"${Kp}\", i: 3, d: 4}") + sampled) +
                         bounds("servo0",
                                {"phase_margin", "delay_margin", "bandwidth", "sensitivity",
                                 "complementary_sensitivity"},
                                kSampledPoles),
                     1e-7, 1);
}

// The current is a state behind those of controllers, and an inner loop may read it.
TEST(RestNumbers, OfMotorsAndTheirCurrents) {
  const std::string motor = carts(
      1,
      {sprung(4.0, 0.1) +
       R"(<codesign:actuator rotor_inertia="0" resistance="0.5" torque_constant="0.2" inductance="0.01"/>)"});
  expect_derivatives(motor,
                     tuned({{"p", 20.0}, {"d", 2.0}}) +
                         controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}")) +
                         bounds("servo0", {"phase_margin", "delay_margin", "sensitivity"}),
                     1e-7, 2);
  for (const std::string sampled : {"", ", sample_time: 0.002"})
    expect_derivatives(
        motor,
        tuned({{"p", 3.0}, {"i", 200.0}, {"k", 60.0}}) +
            controlled("outer: {type: state_feedback, feedback: [{signal: x0/position, gain: "
                       "\"${k}\", reference: 0.1}, {signal: x0/velocity, gain: 8}]" +
                       (sampled.empty() ? "" : std::string(", sample_time: 0.006")) +
                       "}, inner: {type: pid, input: x0/current - outer/output, setpoint: 0, "
                       "output: x0, gains: {p: \"${p}\", i: \"${i}\"}" +
                       sampled + "}") +
            bounds("inner", {"phase_margin", "delay_margin", "bandwidth"}),
        1e-7, 1);
}

// Chains of filters before a PID with all of its memory, and before each signal of a feedback.
TEST(RestNumbers, OfSampledFilters) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"p", 6.0}, {"i", 2.0}, {"d", 1.2}, {"w", 9.0}, {"width", 0.4}, {"zero", 2.0}}) +
          controlled(cart_servo(
              "gains: {p: \"${p}\", i: \"${i}\", d: \"${d}\"}, derivative_filter: 0.01, "
              "sample_time: 0.02, delay: 0.01, filter: [{type: notch, frequency: \"${w}\", "
              "damping: \"${width}\", depth: 0.1}, {type: lead_lag, zero: \"${zero}\", pole: 12}, "
              "{type: low_pass, frequency: 20}]")) +
          bounds("servo0", kSampledMeasures, kSampledPoles),
      1e-7, 3);
  expect_derivatives(
      kPendulum,
      tuned({{"p", 30.0}, {"d", 3.0}, {"w", 15.0}}) + "  l: {}\n" +
          "duration: 10\ncontrollers: {servo: {type: state_feedback, output: hinge, sample_time: "
          "0.01, feedback: [{signal: hinge/position, gain: \"${p}\", reference: 0.7, filter: "
          "{type: low_pass_2, frequency: \"${w}\"}}, {signal: \"${sin(hinge/velocity)}\", gain: "
          "\"${d}\", filter: {type: low_pass, frequency: \"${2*w}\"}}]}}\n" +
          bounds("servo", kSampledMeasures, kSampledPoles),
      1e-7, 2);
}

// A filter of its own, which a later controller reads at the same instant.
TEST(RestNumbers, OfASampledFilterThatOthersRead) {
  expect_derivatives(
      carts(1, {damped(1.0)}),
      tuned({{"p", 6.0}, {"d", 3.0}, {"w", 4.0}}) +
          controlled("smooth: {type: state_feedback, sample_time: 0.02, feedback: [{signal: "
                     "x0/velocity, gain: -1.0, filter: {type: low_pass, frequency: \"${w}\"}}]}, "
                     "servo: {type: state_feedback, output: x0, sample_time: 0.02, feedback: "
                     "[{signal: x0/position, gain: \"${p}\"}, {signal: smooth/output, gain: "
                     "\"${d}\"}]}") +
          bounds("servo", kSampledMeasures, kSampledPoles),
      1e-7, 2);
}

// A disturbance observer finds the weight of the arm, continuously and sampled with a delay, and a
// Kalman filter feeds a cart.
TEST(RestNumbers, OfObservers) {
  for (const std::string sampled : {"", ", sample_time: 0.01, delay: 0.004"}) {
    const bool is_sampled = !sampled.empty();
    expect_derivatives(
        kPendulum,
        tuned({{"p", 30.0}, {"J", 0.4}, {"w", 4.0}}) + "  l: {}\n" +
            "duration: 10\ncontrollers: {eye: {type: observer, joint: hinge, inertia: \"${J}\", "
            "bandwidth: \"${w}\", disturbance: true" +
            (is_sampled ? ", sample_time: 0.01" : "") +
            "}, servo: {type: state_feedback, output: hinge, feedback: [{signal: eye/position, "
            "gain: \"${p}\", reference: 0.7}, {signal: eye/velocity, gain: 5}, {signal: "
            "eye/disturbance, gain: 1}]" +
            sampled + "}}\n" +
            bounds("servo", {"phase_margin", "sensitivity"}, is_sampled ? kSampledPoles : kOfPoles),
        1e-7, 2);
    expect_derivatives(
        carts(1, {damped(1.0)}),
        tuned({{"p", 30.0}, {"noise", 2.0}}) +
            controlled(std::string("eye: {type: observer, joint: x0, inertia: 1.3, process: "
                                   "\"${noise}\", measurement: 1.0e-5") +
                       (is_sampled ? ", sample_time: 0.01" : "") +
                       "}, servo: {type: state_feedback, output: x0, feedback: [{signal: "
                       "eye/position, gain: \"${p}\"}, {signal: eye/velocity, gain: 5}]" +
                       sampled + "}") +
            bounds("servo", {"phase_margin", "sensitivity"}, is_sampled ? kSampledPoles : kOfPoles),
        1e-7, 2);
  }
}

// s^2 + d s + p at critical damping: the mean of both poles.
TEST(RestNumbers, OfPolesThatMeet) {
  const Problem problem =
      loaded(carts(1, {""}), tuned({{"p", 4.0}, {"d", 4.0}}) +
                                 controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}")) +
                                 "constraints:\n" + kOfPoles);
  RestNumbers numbers(*system_of(problem));
  const Status status = numbers.evaluate(problem.parameters(), true, nullptr);
  ASSERT_TRUE(status.ok()) << status.cause;
  const RestNumbers::Entry growth = numbers.entries()[0], damping = numbers.entries()[1];
  for (Eigen::Index place = 0; place < 2; ++place) {
    EXPECT_NEAR(growth.values[place], -2.0, 1e-12);
    EXPECT_NEAR(growth.gradients(0, place), 0.0, 1e-11);
    EXPECT_NEAR(growth.gradients(1, place), -0.5, 1e-11);
    EXPECT_NEAR(damping.values[place], 1.0, 1e-12);
    EXPECT_NEAR(damping.gradients(1, place), 0.0, 1e-11);
  }
}

// An elastic drive beyond its resonance: three crossings of |L| = 1 and two peaks of |S|, each with
// a place of its own.
TEST(RestNumbers, OfEachCrossing) {
  const std::string urdf = carts(2, {damped(0.5), sprung(40.0, 0.1)}, true);
  const std::string study =
      tuned({{"p", 20.0}, {"d", 2.0}}) +
      controlled(cart_servo("gains: {p: \"${p}\", d: \"${d}\"}, time_constant: 0.002")) +
      bounds("servo0", {"phase_margin", "delay_margin", "sensitivity"});
  expect_derivatives(urdf, study, 1e-7, 3);
  const Problem problem = loaded(urdf, study);
  RestNumbers numbers(*system_of(problem));
  ASSERT_TRUE(numbers.evaluate(problem.parameters(), false, nullptr).ok());
  for (const std::size_t entry : {2U, 3U, 4U})
    EXPECT_GT(std::abs(numbers.entries()[entry].values[1] - numbers.entries()[entry].values[0]),
              1e-3)
        << entry;
}

TEST(RestNumbers, TellWhatThereIsNot) {
  const auto told = [](const std::string& urdf, const std::string& study) {
    const Problem problem = loaded(urdf, study);
    RestNumbers numbers(*system_of(problem));
    return numbers.evaluate(problem.parameters(), true, nullptr);
  };
  const auto servo = [](const std::string& gains) {
    return tuned({{"p", 4.0}}) + controlled(cart_servo("gains: {p: \"${p}\", " + gains + "}"));
  };
  const Status infinite =
      told(carts(1, {damped(1.0)}), servo("d: 1") + bounds("servo0", {"gain_margin"}));
  EXPECT_EQ(infinite.code, StatusCode::kNonFinite);
  EXPECT_NE(infinite.cause.find("\"servo0\" has no gain_margin"), std::string::npos)
      << infinite.cause;
  const Status unstable = told(carts(1, {""}), servo("d: -1") + bounds("servo0", {"phase_margin"}));
  EXPECT_EQ(unstable.code, StatusCode::kUnstableMotion);
  EXPECT_NE(unstable.cause.find("unstable: fastest growth 0.5 1/s"), std::string::npos)
      << unstable.cause;
  // A speed loop cannot rest away from speed zero.
  const Status moving =
      told(carts(1, {""}),
           tuned({{"p", 4.0}}) +
               "duration: 10\ncontrollers: {c: {type: pid, input: x0/velocity, setpoint: "
               "1, output: x0, gains: {p: \"${p}\"}}}\nconstraints:\n" +
               kOfPoles);
  EXPECT_EQ(moving.code, StatusCode::kNoEquilibrium) << moving.cause;
}

}  // namespace
}  // namespace codesign
