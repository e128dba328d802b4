// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Rate limits of controllers, theory (53a), and feedforward by the derivatives of a set-point.
#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"
#include "linear/linear_model.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

std::string limited_cart(const std::string& more = "") {
  return robot(more + mass("cart", 2.0) + lift("axis", "cart", 0.0));
}

std::string limited_study(const std::string& controllers) {
  return "duration: 1.0\ngravity: [0, 0, 0]\ncontrollers: {" + controllers +
         "}\nsolver: {method: rodas5p, relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-13}\n";
}

TEST(RateLimit, OfSamplesIsACorner) {
  const std::string step =
      "command: {type: state_feedback, output: axis, feedforward: \"${t < 0.049 ? 3 : t < 0.099 ? "
      "10 : 0}\", sample_time: 0.01, rate_limit: [-20, 50]";
  for (const std::string& delay : {std::string("}"), std::string(", delay: 0.025}")}) {
    const double late = delay.size() > 1 ? 0.025 : 0.0;
    const auto effort = [&](double t) {
      return end_of(limited_cart(), limited_study(step + delay), t + late, {"axis/effort"})[0];
    };
    EXPECT_NEAR(effort(0.005), 3.0, 1e-14) << "the first sample is free";
    EXPECT_NEAR(effort(0.055), 3.5, 1e-12) << "50 * 0.01 from sample to sample";
    EXPECT_NEAR(effort(0.095), 5.5, 1e-12);
    EXPECT_NEAR(effort(0.105), 5.3, 1e-12) << "and 20 * 0.01 down";
    EXPECT_NEAR(effort(0.205), 3.3, 1e-12);
    EXPECT_NEAR(effort(0.505), 0.0, 1e-12);
  }
}

// From scipy.integrate.solve_ivp (DOP853, rtol 1e-13, atol 1e-14) of f' = S((u - f)/0.1).
TEST(RateLimit, OfALagIsSmooth) {
  const auto effort = [](const std::string& u, double t) {
    return end_of(limited_cart(),
                  limited_study("command: {type: state_feedback, output: axis, feedforward: " + u +
                                ", time_constant: 0.1, rate_limit: [-20, 50]}"),
                  t, {"axis/effort"})[0];
  };
  EXPECT_NEAR(effort("10.0", 0.25), 8.852427811764, 1e-9);
  EXPECT_NEAR(effort("-4.0", 0.15), -2.752673933095, 1e-9);
}

TEST(RateLimit, ItsNumbersHaveExactGradients) {
  for (const char* run : {"sample_time: 0.01", "time_constant: 0.1"})
    for (const char* gradient : {"direct", "adjoint"}) {
      const Problem problem = load_problem(
          {"cart.urdf", limited_cart("<codesign:parameter name='up' value='15'/>")}, {},
          {"cart.yaml",
           "duration: 2.0\ngravity: [0, 0, 0]\ncontrollers: {servo: {type: pid, input: "
           "axis/position, setpoint: {type: sine, amplitude: 0.3, frequency: 0.5}, output: axis, "
           "gains: {p: \"${p}\", d: 8.0}, rate_limit: "
           "[\"${-down}\", \"${up}\"], " +
               std::string(run) +
               "}}\nparameters: {up: {}, down: {initial: 10.0}, p: {initial: 20.0}}\nobjective: "
               "{integral: [{signal: axis/position, reference: 1.0}, {signal: axis/effort, weight: "
               "1e-3}]}\nsolver: {gradient: " +
               gradient + "}\n"});
      const GradientCheck check =
          check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
      ASSERT_TRUE(check.status.ok()) << run << check.status.cause;
      EXPECT_LT(check.largest_relative_difference, 1e-8) << run << gradient;
      EXPECT_GT(check.evaluation.gradient.cwiseAbs().minCoeff(), 1e-9) << run;
    }
}

TEST(RateLimit, NeedsSamplesOrALag) {
  try {
    compile(limited_cart(),
            limited_study("command: {type: pid, input: axis/position, setpoint: 1.0, output: axis, "
                          "gains: {p: 1.0}, rate_limit: 5}"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the output of a continuous controller may jump"),
              std::string::npos)
        << error.what();
  }
}

// m r'' + c r' along r = 0.3 sin(w t), from the motion itself: no error is left to the servo.
TEST(Feedforward, OfRateAndAccelerationLeavesNoError) {
  const double w = 2.0 * M_PI * 0.5, t = 0.7;
  const std::string damped =
      robot(mass("cart", 2.0) + lift("axis", "cart", 0.0, "<dynamics damping='3'/>"));
  const std::string text =
      "duration: 1.0\ngravity: [0, 0, 0]\ninitial_state: {axis: {position: 0, velocity: " +
      std::to_string(0.3 * w) +
      "}}\ncontrollers: {servo: {type: pid, input: axis/position, setpoint: {type: sine, "
      "amplitude: 0.3, frequency: 0.5}, output: axis, gains: {p: 1.0}}, ahead: {type: "
      "state_feedback, output: axis, feedback: [{signal: servo/setpoint_acceleration, gain: -2.0}, "
      "{signal: servo/setpoint_rate, gain: -3.0}]}}\nsolver: {method: rodas5p, "
      "relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-12}\n";
  const std::vector<double> y =
      end_of(damped, text, t,
             {"servo/error", "servo/setpoint_rate", "servo/setpoint_acceleration", "ahead/output"});
  EXPECT_NEAR(y[0], 0.0, 1e-6);
  EXPECT_NEAR(y[1], 0.3 * w * std::cos(w * t), 1e-12);
  EXPECT_NEAR(y[2], -0.3 * w * w * std::sin(w * t), 1e-12);
  EXPECT_NEAR(y[3], 2.0 * y[2] + 3.0 * y[1], 1e-12);
}

}  // namespace
}  // namespace codesign
