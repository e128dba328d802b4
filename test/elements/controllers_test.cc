// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Each law's value at points computed by hand, and its derivatives by state and time.
#include <gtest/gtest.h>

#include "edited_text.h"
#include "equations/arm.h"
#include "equations/compiled.h"
#include "equations/equations_fixture.h"
#include "equations/formulas.h"

namespace codesign {
namespace {

constexpr const char* kSine = "{type: sine, amplitude: 0.7, period: 1.3, phase: 0.4}";
constexpr const char* kPoints =
    "{type: waypoints, times: [0.1, 0.5, 0.9], positions: [0.2, -0.5, 1.0]}";

std::string study(const std::string& controllers, const std::string& terms) {
  return "duration: 1.0\ngravity: [1.0, -2.0, -9.0]\ncontrollers:\n" + controllers +
         "objective: {integral: [" + terms + "]}\n";
}

void expect_exact(const std::string& urdf, const std::string& text) {
  EquationsFixture fixture(urdf, text);
  fixture.state.t = 0.37;
  fixture.expect_exact_derivatives(1e-11);
}

TEST(EquationsControllers, APidThatFollowsAMovingSetpointHasExactDerivatives) {
  expect_exact(double_pendulum(), study("  a: {type: pid, input: shoulder/position, output: "
                                        "shoulder, gains: {p: 3.0, i: 2.0, d: 0.5}, setpoint: " +
                                            std::string(kSine) +
                                            "}\n  b: {type: pid, input: a/error - elbow/position, "
                                            "output: elbow, gains: {p: 1.0, d: 0.7}, setpoint: " +
                                            kPoints + "}\n",
                                        "{signal: a/output, reference: " + std::string(kPoints) +
                                            "}, {signal: b/error + b/output}"));
}

// The rate of the expression is exact, with the time in it, branches and another controller.
TEST(EquationsControllers, APidOfAnExpressionHasExactDerivatives) {
  for (const char* input :
       {"${cos(shoulder/position)*sin(elbow/position + 3*t) + elbow/position^2}",
        "${max(shoulder/position, 0.1*elbow/position)/(2 + shoulder/velocity^2)}",
        "${abs(shoulder/position) + sqrt(2 + elbow/position)*exp(-t)}"})
    expect_exact(
        double_pendulum(),
        study(std::string("  a: {type: pid, input: \"") + input +
                  "\", output: shoulder, gains: {p: 3.0, i: 2.0, d: 0.5}, setpoint: " + kSine +
                  "}\n  b: {type: state_feedback, output: elbow, feedback: "
                  "[{signal: \"${a/error*elbow/velocity}\", gain: 0.4}]}\n",
              "{signal: a/output + b/output}"));
}

// What an expression says in another way gives the same controller.
TEST(EquationsControllers, AnExpressionIsTheSignalThatItMeans) {
  const auto output = [](const std::string& input) {
    Compiled c(double_pendulum(),
               study("  a: {type: pid, input: \"" + input +
                         "\", output: shoulder, gains: {p: 3.0, d: 0.5}, setpoint: 0.3}\n",
                     "{signal: a/output}") +
                   "initial_state: {shoulder: {position: 0.4, velocity: 1.5}, elbow: {position: "
                   "-0.2, velocity: 0.7}}\n");
    EXPECT_TRUE(c.start().ok());
    c.equations.formulas().load(c.state);
    return c.equations.formulas().controller_output(0);
  };
  EXPECT_NEAR(output("${(shoulder/position^2 - elbow/position^2)/(shoulder/position + "
                     "elbow/position)}"),
              output("shoulder/position - elbow/position"), 1e-14);
}

TEST(EquationsControllers, GravityCompensationHasExactDerivatives) {
  for (const char* joint : {"travel", "turn", "reach", "wrist"})
    expect_exact(crane(), study(std::string("  servo: {type: pd_gravity, output: ") + joint +
                                    ", gains: {p: 3.0, d: 0.5}, setpoint: " + kSine + "}\n",
                                std::string("{signal: ") + joint + "/effort}"));
}

/// The crane without its bob: computed torque needs a tree of hinges and slides, and the bob hangs
/// on a ball joint.
std::string arm() {
  std::string urdf = crane();
  const std::size_t begin = urdf.find("<joint name='ball_x'"), end = urdf.find("</robot>");
  urdf.erase(begin, end - begin);
  for (const char* link : {"<link name='bob'", "<link name='a'/>", "<link name='b'/>"}) {
    const std::size_t at = urdf.find(link);
    urdf.erase(at, std::string(link).find("/>") != std::string::npos
                       ? std::string(link).size()
                       : urdf.find("</link>", at) + 7 - at);
  }
  return urdf;
}

std::string torques(const std::vector<std::string>& joints) {
  std::string text;
  for (const std::string& joint : joints)
    text += "  " + joint + "_servo: {type: computed_torque, output: " + joint +
            ", gains: {p: 3.0, d: 0.5}, setpoint: " + kSine + "}\n";
  return text;
}

TEST(EquationsControllers, ComputedTorqueHasExactDerivatives) {
  expect_exact(arm(), study(torques({"travel", "turn", "reach", "wrist"}),
                            "{signal: turn/effort}, {signal: reach_servo/output, weight: 0.1}"));
  expect_exact(arm(), study(torques({"turn", "wrist"}), "{signal: wrist/effort}"));
}

/// arm() with an actuator, and so a rotor, in every joint.
std::string geared_arm() {
  return replaced_all(arm(), "</joint>",
                      "<codesign:actuator gear_ratio='-8' rotor_inertia='0.003'/></joint>");
}

TEST(EquationsControllers, ComputedTorqueOfRotorsHasExactDerivatives) {
  expect_exact(geared_arm(),
               study(torques({"travel", "turn", "reach", "wrist"}),
                     "{signal: turn/effort}, {signal: reach_servo/output, weight: 0.1}"));
  expect_exact(geared_arm(),
               study(torques({"turn", "wrist"}), "{signal: wrist/effort}, {signal: turn/effort}"));
}

TEST(EquationsControllers, StateFeedbackAndShapedInputsHaveExactDerivatives) {
  expect_exact(
      double_pendulum(),
      study(
          "  a: {type: state_feedback, output: shoulder, feedforward: " + std::string(kSine) +
              ", feedback: [{signal: shoulder/position, gain: 3.0, reference: " + kPoints +
              "}, {signal: elbow/velocity - lower/velocity/x, gain: -0.4}]}\n"
              "  b: {type: basis, shape: cubic, output: elbow, coefficients: [1.0, -2.0, 3.0, 0.5, "
              "1.0, 2.0]}\n"
              "  c: {type: basis, output: elbow, coefficients: [1.0, -2.0, 3.0, 0.5, 1.0, 2.0]}\n",
          "{signal: a/output + b/output - c/output}"));
}

TEST(EquationsControllers, AWrongTimeDerivativeIsNoticed) {
  EquationsFixture fixture(
      double_pendulum(),
      study("  a: {type: pid, input: elbow/position, output: elbow, gains: {p: 3.0}, setpoint: " +
                std::string(kSine) + "}\n",
            "{signal: a/error}"));
  fixture.state.t = 0.37;
  const Eigen::VectorXd reference = fixture.time_reference();
  EXPECT_GT(reference.cwiseAbs().maxCoeff(), 0.1);
  EXPECT_GT(compare_jacobians(Eigen::VectorXd::Zero(reference.size()), reference).largest, 1e-3);
}

// m g l sin(theta) / 2 of a bar of 1 kg and 1 m that hangs along -z; a positive turn about y lifts
// it towards -x.
TEST(EquationsControllers, GravityCompensationOfABarIsItsMoment) {
  Compiled c(pendulum(), let_go("{hinge: {position: 0.4}}", "hinge/position",
                                "controllers: {hold: {type: pd_gravity, output: hinge, setpoint: "
                                "0.5, gains: {p: 2.0, d: 1.0}}}\n"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().controller_output(0), 2.0 * 0.1 + 9.81 * 0.5 * std::sin(0.4),
              1e-12);
}

TEST(EquationsControllers, WhatIsHeldAgainstGravityStaysWhereItIs) {
  std::string controllers = "controllers:\n";
  for (const char* joint : {"travel", "turn", "reach", "wrist"})
    controllers += std::string("  ") + joint + "_hold: {type: pd_gravity, output: " + joint +
                   ", setpoint: 0.3, gains: {p: 2.0}}\n";
  Compiled c(arm(), let_go("{travel: {position: 0.3}, turn: {position: 0.3}, reach: {position: "
                           "0.3}, wrist: {position: 0.3}}",
                           "turn/position", controllers));
  ASSERT_TRUE(c.start().ok());
  EXPECT_LT(c.state.z.head(c.system.layout().n).cwiseAbs().maxCoeff(), 1e-11);
}

class ComputedTorque : public ::testing::TestWithParam<bool> {};

TEST_P(ComputedTorque, GivesEachJointTheAccelerationAskedFor) {
  Compiled c(
      GetParam() ? geared_arm() : arm(),
      let_go("{travel: {position: 0.3, velocity: 0.5}, turn: {position: 1.3, velocity: -2.0}, "
             "reach: {position: 0.1, velocity: 0.7}, "
             "wrist: {position: -0.6, velocity: 3.0}}",
             "turn/position", "controllers:\n" + torques({"travel", "turn", "reach", "wrist"})));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  const double w = 2.0 * M_PI / 1.3, s = 0.7 * std::sin(0.4), cosine = 0.7 * std::cos(0.4);
  for (const JointLoad& load : c.system.loads()) {
    const CoordinateMotion<double> m = c.equations.formulas().coordinate(load.pair, load.element);
    EXPECT_NEAR(m.acceleration, -w * w * s + 0.5 * (w * cosine - m.rate) + 3.0 * (s - m.position),
                1e-9);
  }
  EXPECT_EQ(c.system.loads().size(), 4U);
  EXPECT_EQ(c.system.rotors().size(), GetParam() ? 4U : 0U);
}

INSTANTIATE_TEST_SUITE_P(Arms, ComputedTorque, ::testing::Bool(),
                         [](const auto& c) { return c.param ? "WithRotors" : "Plain"; });

// At the inner joint the whole double pendulum moves as one bar if the elbow's acceleration is
// prescribed as zero; theory (C6).
TEST(EquationsControllers, JointsWithoutComputedTorqueAreTakenToKeepTheirRates) {
  Compiled c(double_pendulum(),
             "duration: 1.0\ngravity: [0, 0, 0]\ncontrollers: {servo: {type: computed_torque, "
             "output: shoulder, setpoint: 1.0, gains: {p: 3.0}}}\n"
             "objective: {integral: [{signal: servo/output}]}\n");
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  // Two bars of 1 kg, inertia 0.0834 about their centres, 0.5 m and 1.5 m below the shoulder.
  EXPECT_NEAR(c.equations.formulas().controller_output(0), 3.0 * (2.0 * 0.0834 + 0.25 + 2.25),
              1e-12);
}

TEST(EquationsControllers, StateFeedbackByHand) {
  Compiled c(pendulum(), let_go("{hinge: {position: 0.4, velocity: -2.0}}", "hinge/position",
                                "controllers: {hold: {type: state_feedback, output: hinge, "
                                "feedforward: 1.5, feedback: [{signal: hinge/position, gain: 3.0, "
                                "reference: 0.1}, {signal: hinge/velocity, gain: 0.25}]}}\n"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().controller_output(0), 1.5 - 3.0 * 0.3 + 0.25 * 2.0, 1e-13);
}

}  // namespace
}  // namespace codesign
