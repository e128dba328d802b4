// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/linearize.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "statics/linear_cases.h"

namespace codesign {
namespace {

TEST(Linearize, AMassOnASpring) {
  const LinearModel model =
      model_of(carts(1, {sprung(4.0, 0.4)}), controlled(""), {"x0/position", "x0/acceleration"});
  expect_poles(model, {{-0.2, std::sqrt(3.96)}}, 1e-12);
  EXPECT_EQ(model.system.states, (std::vector<std::string>{"x0/position", "x0/velocity"}));
  EXPECT_NEAR(model.system.C(1, 0), -4.0, 1e-14);
  EXPECT_NEAR(model.system.C(1, 1), -0.4, 1e-14);
}

TEST(Linearize, TwoCartsOnASpringDriftTogether) {
  const LinearModel model = model_of(carts(2, {"", sprung(8.0)}, true), controlled(""));
  EXPECT_EQ(model.stability, Stability::kNeutral) << model.verdict;
  double fastest = 0.0;
  for (const LinearMode& mode : model.modes) fastest = std::max(fastest, std::abs(mode.pole.value));
  EXPECT_NEAR(fastest, 4.0, 1e-12) << "k (1/m1 + 1/m2)";
}

// (2 +- sqrt 2) g/l for two equal point masses on equal strings.
TEST(Linearize, ADoublePendulum) {
  const auto bob = [](const std::string& name) {
    return "<link name=\"" + name + R"("><inertial><origin xyz="0 0 -1"/><mass value="1"/>
      <inertia ixx="1e-30" iyy="1e-30" izz="1e-30" ixy="0" ixz="0" iyz="0"/></inertial></link>)";
  };
  const std::string urdf = R"(<robot name="p"><link name="base"/>)" + bob("one") + bob("two") +
                           joint("a", "continuous", "base", "one", "0 0 0", "0 1 0") +
                           joint("b", "continuous", "one", "two", "0 0 -1", "0 1 0") + "</robot>";
  const LinearModel model = model_of(urdf, "duration: 10\n");
  expect_poles(model,
               {{0.0, std::sqrt((2.0 - std::sqrt(2.0)) * kGravity)},
                {0.0, std::sqrt((2.0 + std::sqrt(2.0)) * kGravity)}},
               1e-9);
  EXPECT_NEAR(model.modes[0].rates[1] / model.modes[0].rates[0], std::sqrt(2.0) - 1.0, 1e-9);
}

TEST(Linearize, ADoubleIntegratorUnderPd) {
  const LinearModel model = model_of(carts(1, {""}), controlled(cart_servo("gains: {p: 4, d: 2}")));
  expect_poles(model, {{-1.0, std::sqrt(3.0)}}, 1e-12);
  // |4 + 2 j w| = w^2
  const double w = std::sqrt(2.0 + std::sqrt(20.0));
  const LoopMargins& margins = model.loops.at(0).margins;
  EXPECT_NEAR(margins.phase_margin->frequency, w, 1e-9);
  EXPECT_NEAR(margins.phase_margin->value, std::atan(w / 2.0), 1e-9);
  EXPECT_FALSE(margins.gain_margin);
}

TEST(Linearize, AMotorUnderProportionalControl) {
  const LinearModel model =
      model_of(carts(1, {damped(1.0)}), controlled(cart_servo("gains: {p: 1}")));
  expect_poles(model, {{-0.5, std::sqrt(0.75)}}, 1e-12);
  const double w = std::sqrt(0.5 * (std::sqrt(5.0) - 1.0));
  EXPECT_NEAR(model.loops.at(0).margins.phase_margin->value, std::atan(1.0 / w), 1e-9);
}

// 1/((s + 1)^2 (s + 1)), the last one the lag of the drive.
TEST(Linearize, ThreeLags) {
  const LinearModel model = model_of(carts(1, {sprung(1.0, 2.0)}),
                                     controlled(cart_servo("gains: {p: 1}, time_constant: 1")));
  const LoopMargins& margins = model.loops.at(0).margins;
  EXPECT_NEAR(margins.gain_margin->value, 8.0, 1e-9);
  EXPECT_NEAR(margins.gain_margin->frequency, std::sqrt(3.0), 1e-9);
  EXPECT_EQ(model.system.states.back(), "servo0/lag");
}

// s^2 (s/6 + 1) + (s/6 + 1) + 10/6 s: (s + 1)(s + 2)(s + 3).
TEST(Linearize, AFilteredDerivative) {
  const LinearModel model =
      model_of(carts(1, {""}), controlled(cart_servo("gains: {p: 1, d: 1.6666666666666667}, "
                                                     "derivative_filter: 0.16666666666666666")));
  expect_poles(model, {-1.0, -2.0, -3.0}, 1e-9);
}

// m g l = 9.81: the gain of 20 may fall to 9.81.
constexpr double kTurn = 6.283185307179586;

// (4 + 2 s) N(s) / s^2 with the notch N, in continuous time.
TEST(Linearize, ANotchInTheLoop) {
  const LinearModel model = model_of(
      carts(1, {""}),
      controlled(cart_servo("gains: {p: 4, d: 2}, filter: {type: notch, frequency: 3, damping: "
                            "0.5, depth: 0.1}")));
  const ControllerLoop& loop = model.loops.at(0);
  ASSERT_FALSE(loop.frequencies.empty());
  const double w = 3.0 * kTurn;
  for (std::size_t k = 0; k < loop.frequencies.size(); ++k) {
    const std::complex<double> s(0.0, loop.frequencies[k]);
    const std::complex<double> expected =
        (4.0 + 2.0 * s) * (s * s + 0.1 * w * s + w * w) / (s * s + w * s + w * w) / (s * s);
    EXPECT_LT(std::abs(loop.response[k] - expected), 1e-9 * std::abs(expected))
        << loop.frequencies[k];
  }
  EXPECT_EQ(model.system.states.back(), "servo0/feedback_filter[1]");
}

// The sampled cart has T^2/2 (z + 1)/(z - 1)^2 behind a held output; the filters are those of the
// bilinear transform.
TEST(Linearize, SampledFiltersInTheLoop) {
  constexpr double kTime = 0.02;
  const LinearModel model = model_of(
      carts(1, {""}),
      controlled(cart_servo("gains: {p: 4}, sample_time: 0.02, filter: [{type: lead_lag, zero: "
                            "0.2, pole: 6}, {type: notch, frequency: 10, damping: 0.5}]")));
  const ControllerLoop& loop = model.loops.at(0);
  ASSERT_FALSE(loop.frequencies.empty());
  const double w = 10.0 * kTurn, scale = w / std::tan(0.5 * w * kTime);
  for (std::size_t k = 0; k + 1 < loop.frequencies.size(); ++k) {
    const std::complex<double> z = std::polar(1.0, loop.frequencies[k] * kTime);
    const std::complex<double> s = 2.0 / kTime * (z - 1.0) / (z + 1.0);
    const std::complex<double> n = scale * (z - 1.0) / (z + 1.0);
    const std::complex<double> expected =
        4.0 * (1.0 + s / (0.2 * kTurn)) / (1.0 + s / (6.0 * kTurn)) * (n * n + w * w) /
        (n * n + w * n + w * w) * 0.5 * kTime * kTime * (z + 1.0) / ((z - 1.0) * (z - 1.0));
    EXPECT_LT(std::abs(loop.response[k] - expected), 1e-8 * std::abs(expected) + 1e-12)
        << loop.frequencies[k];
  }
}

// Within its limit a loop with anti-windup is the loop without; at rest a filter passes its input.
TEST(Linearize, AntiWindupAtRestIsNotSeen) {
  const std::string gains = "gains: {p: 4, i: 3, d: 2}";
  const LinearModel plain = model_of(carts(1, {sprung(1.0)}), controlled(cart_servo(gains)));
  for (const char* method : {"back_calculation", "conditional"}) {
    const LinearModel model =
        model_of(carts(1, {sprung(1.0)}),
                 controlled(cart_servo(gains + ", output_limit: [-1, 9], antiwindup: " + method)));
    ASSERT_EQ(model.modes.size(), plain.modes.size());
    for (std::size_t k = 0; k < plain.modes.size(); ++k)
      EXPECT_LT(std::abs(model.modes[k].pole.value - plain.modes[k].pole.value), 1e-12);
  }
}

// A motor by resistance, inductance and constant, as two controllers say it:
// L s^3 + R s^2 + k^2 s + k p with the mass 1.
TEST(Linearize, AMotorByTwoControllers) {
  const double R = 0.5, L = 0.01, k = 0.2, p = 30.0;
  const LinearModel model = model_of(
      carts(1, {""}),
      controlled("amplifier: {type: pid, input: x0/position, setpoint: 0, gains: {p: 30}, "
                 "output_limit: 24}, motor: {type: state_feedback, output: x0, feedback: [{signal: "
                 "amplifier/output, gain: -0.4}, {signal: x0/velocity, gain: 0.08}], "
                 "time_constant: 0.02}"));
  ASSERT_EQ(model.modes.size(), 2U);
  for (const LinearMode& mode : model.modes) {
    const std::complex<double> s = mode.pole.value;
    const double size = L * std::pow(std::abs(s), 3);
    EXPECT_LT(std::abs(((L * s + R) * s + k * k) * s + k * p), 1e-10 * (size + k * p)) << s;
  }
}

std::string motor(const std::string& winding) {
  return R"(<codesign:actuator rotor_inertia="0" resistance="0.5" torque_constant="0.2")" +
         winding + "/>";
}

// The same cubic, and without L the square R s^2 + K^2 s + K p.
TEST(Linearize, AMotorByItsVoltage) {
  const double R = 0.5, L = 0.01, k = 0.2, p = 30.0;
  const std::string servo = controlled(cart_servo("gains: {p: 30}"));
  const LinearModel model =
      model_of(carts(1, {motor(R"( inductance="0.01" bus_voltage="24")")}), servo, {"x0/current"});
  ASSERT_EQ(model.modes.size(), 2U);
  for (const LinearMode& mode : model.modes) {
    const std::complex<double> s = mode.pole.value;
    const double size = L * std::pow(std::abs(s), 3);
    EXPECT_LT(std::abs(((L * s + R) * s + k * k) * s + k * p), 1e-9 * (size + k * p)) << s;
  }
  EXPECT_EQ(model.system.states,
            (std::vector<std::string>{"x0/position", "x0/velocity", "x0/current"}));
  EXPECT_NEAR(model.system.C(0, 2), 1.0, 1e-15);
  // The loop is K p / (s (L s + R) s + K^2 s).
  const ControllerLoop& loop = model.loops.at(0);
  for (std::size_t j = 0; j < loop.frequencies.size(); ++j) {
    const std::complex<double> s(0.0, loop.frequencies[j]);
    const std::complex<double> expected = k * p / (s * (s * (L * s + R) + k * k));
    EXPECT_LT(std::abs(loop.response[j] - expected), 1e-9 * std::abs(expected));
  }
  const LinearModel at_once = model_of(carts(1, {motor("")}), servo);
  const std::complex<double> root =
      std::sqrt(std::complex<double>(k * k * k * k - 4.0 * R * k * p));
  expect_poles(at_once, {(-k * k + root) / (2.0 * R)}, 1e-9);
}

// A servo of the voltage against a spring of 4 N/m about 0.3: u = p (1 - x), K u/R = 4 (x - 0).
TEST(Linearize, AMotorAtRestHasItsSteadyCurrent) {
  const double R = 0.5, k = 0.2, p = 30.0;
  const std::string urdf = carts(1, {sprung(4.0, 0.1) + motor(R"( inductance="0.01")")});
  const LinearModel model = model_of(
      urdf,
      controlled("servo0: {type: pid, input: x0/position, setpoint: 1.0, output: x0, gains: {p: "
                 "30}}"),
      {"x0/position"});
  const double L = 0.01;
  // (L s + R)(s^2 + 0.1 s + 4) + K^2 s + K p = 0
  ASSERT_FALSE(model.modes.empty());
  for (const LinearMode& mode : model.modes) {
    const std::complex<double> s = mode.pole.value;
    EXPECT_LT(std::abs((L * s + R) * (s * s + 0.1 * s + 4.0) + k * k * s + k * p),
              1e-8 * (k * p + L * std::pow(std::abs(s), 3)))
        << s;
  }
}

TEST(Linearize, AnInvertedPendulumUnderPd) {
  const LinearModel model = model_of(
      balanced_arm(2.0, 0.0),
      "duration: 10\ncontrollers: {servo: {type: pid, input: hinge/position, setpoint: 0, output: "
      "hinge, gains: {p: 20, d: 4}}}\n");
  const double inertia = 0.01 + 2.0 * 0.25;
  expect_poles(
      model,
      {{-2.0 / inertia, std::sqrt((20.0 - kGravity) / inertia - std::pow(2.0 / inertia, 2))}},
      1e-9);
  EXPECT_NEAR(model.loops.at(0).margins.gain_reduction->value, kGravity / 20.0, 1e-10);
}

// x' of the slider by the crank, and the moving mass that the crank feels.
TEST(Linearize, ALoopOfJoints) {
  const std::string spring =
      R"(<codesign:torsion_spring stiffness="200" damping="0" free_position="0.3"/>)";
  const std::string study =
      "duration: 10\ngravity: [0, 0, 0]\ninitial_state: {crank_joint: {position: 0.7}, "
      "slider_joint: {guess: 0.35}}\nloads: [{joint: slider_joint, effort: 8}]\n";
  for (const std::string coordinates : {"joint", "absolute"}) {
    const LinearModel model =
        model_of(planar_slider_crank(spring),
                 study + "solver: {coordinates: " + coordinates + "}\n", {"crank_joint/position"});
    // 0.1 cos + sqrt(0.09 - 0.01 sin^2) = 0.34 by the law of cosines.
    const double x = 0.34, cosine = (x * x + 0.01 - 0.09) / (0.2 * x);
    const double sine = std::sqrt(1.0 - cosine * cosine);
    const double slope = -0.1 * sine - 0.01 * sine * cosine / std::sqrt(0.09 - 0.01 * sine * sine);
    const double square = 200.0 * slope * slope / (0.01 + slope * slope);
    expect_poles(model, {{0.0, std::sqrt(square)}}, 1e-8);
    EXPECT_EQ(model.system.A.rows(), 2);
    if (coordinates == "joint") {
      EXPECT_NEAR(model.system.B(1, 0), slope / (0.01 + slope * slope), 1e-9);
      EXPECT_EQ(model.system.inputs[0], "loads[0]/effort");
    }
  }
}

TEST(Linearize, FrictionCountsWhenAsked) {
  const Problem problem =
      loaded(carts(1, {R"(<dynamics damping="0.5" friction="2"/>)"}), controlled(""));
  LinearQuestion question;
  const LinearModel without =
      linearize_at_rest(*system_of(problem), problem.parameters(), question);
  EXPECT_NEAR(without.modes.back().pole.growth(), -0.5, 1e-12);
  question.friction = LinearFriction::kRegularised;
  const LinearModel with = linearize_at_rest(*system_of(problem), problem.parameters(), question);
  EXPECT_LT(with.modes.back().pole.growth(), -100.0);
  EXPECT_EQ(with.verdict.substr(with.verdict.find(';')),
            "; damping, controllers and friction counted");
}

// A set-point's rate reaches the derivative.
TEST(Linearize, InputsOfASetpoint) {
  const LinearModel model =
      model_of(carts(1, {""}), controlled(cart_servo("gains: {p: 4, d: 2}")), {"servo0/error"});
  EXPECT_EQ(
      model.system.inputs,
      (std::vector<std::string>{"servo0/setpoint", "servo0/setpoint_rate", "servo0/disturbance"}));
  EXPECT_NEAR(model.system.B(1, 0), 4.0, 1e-14);
  EXPECT_NEAR(model.system.B(1, 1), 2.0, 1e-14);
  EXPECT_NEAR(model.system.B(1, 2), 1.0, 1e-14);
  EXPECT_NEAR(model.system.D(0, 0), 1.0, 1e-14);
}

// A cart with two pendulums: gains that place the poles at -3, -3.5, ..., -5.5, and the same with
// velocity gains of the other sign.
TEST(Linearize, StateFeedbackPlacesPoles) {
  const auto part = [](const std::string& name, double mass, double height, double inertia,
                       double about) {
    const std::string number = std::to_string(inertia);
    return "<link name=\"" + name + "\"><inertial><origin xyz=\"0 0 " + std::to_string(height) +
           "\"/><mass value=\"" + std::to_string(mass) + "\"/><inertia ixx=\"" + number +
           "\" ixy=\"0\" ixz=\"0\" iyy=\"" + number + "\" iyz=\"0\" izz=\"" +
           std::to_string(about) + "\"/></inertial></link>";
  };
  const std::string urdf =
      R"(<robot name="dip"><link name="ground"/>)" + part("cart", 1.0, 0.0, 0.1, 0.1) +
      part("lower", 0.3, 0.25, 0.006, 0.001) + part("upper", 0.2, 0.3, 0.005, 0.001) +
      joint("rail", "prismatic", "ground", "cart", "0 0 0", "1 0 0",
            R"(<limit effort="0" velocity="0"/><dynamics damping="0.5"/>)") +
      joint("hip", "continuous", "cart", "lower", "0 0 0", "0 1 0", damped(0.01)) +
      joint("knee", "continuous", "lower", "upper", "0 0 0.5", "0 1 0", damped(0.02)) + "</robot>";
  const auto study = [](const std::string& sign) {
    const std::array<const char*, 6> gains{"4.554143403667005",  "32.50835324766638",
                                           "166.3134325767466",  "6.442982146047887",
                                           "21.550643131580546", "20.36884376076116"};
    const std::array<const char*, 6> signals{"rail/position", "hip/position", "knee/position",
                                             "rail/velocity", "hip/velocity", "knee/velocity"};
    std::string text =
        "duration: 12\ncontrollers: {balance: {type: state_feedback, output: rail, feedback: [";
    for (std::size_t k = 0; k < gains.size(); ++k)
      text += std::string(k == 0 ? "" : ", ") + "{signal: " + signals[k] +
              ", gain: " + (k < 3 ? "" : sign) + gains[k] + "}";
    return text + "]}}\n";
  };
  const LinearModel model = model_of(urdf, study(""));
  expect_poles(model, {-3.0, -3.5, -4.0, -4.5, -5.0, -5.5}, 1e-8);
  EXPECT_EQ(model.verdict,
            "stable: slowest pole -3 1/s; damping and controllers counted, friction not");
  EXPECT_EQ(model_of(urdf, study("-")).stability, Stability::kUnstable);
}

// A load that follows the speed drives what it should brake.
TEST(Linearize, ALoadThatFollowsTheSpeed) {
  for (const double slope : {-0.05, 0.05}) {
    const LinearModel model =
        model_of(balanced_arm(2.0, 0.0),
                 "duration: 60\ninitial_state: {hinge: {position: 3.1}}\nloads: [{joint: hinge, "
                 "effort: \"${" +
                     std::to_string(slope) + "*hinge/velocity}\"}]\n");
    EXPECT_NEAR(model.modes[0].pole.growth(), slope / (2.0 * 0.51), 1e-12);
    EXPECT_EQ(model.stability, slope < 0.0 ? Stability::kStable : Stability::kUnstable);
  }
}

// Integrals that only the objective reads, or whose gain is zero, are states of the run alone.
TEST(Linearize, CarriesTheStatesOfARun) {
  const Problem problem = loaded(
      carts(1, {damped(1.0)}),
      "duration: 2\ngravity: [0, 0, 0]\ninitial_state: {x0: {position: 1}}\ncontrollers: {servo0: "
      "{type: pid, input: x0/position, setpoint: 0, output: x0, gains: {p: 4, d: 1, i: \"${Ki}\"}, "
      "derivative_filter: 0.1, time_constant: 0.05}}\nparameters: {Ki: {initial: 0}}\nobjective: "
      "{terminal: [{signal: servo0/integral}]}\n");
  const CompiledSystem& system = *system_of(problem);
  const LinearModel moving = linearize_in_motion(system, problem.parameters(), {}, 1.0);
  ASSERT_TRUE(moving.status.ok()) << moving.status.cause;
  const LinearModel resting = linearize_at_rest(system, problem.parameters(), {});
  EXPECT_EQ(moving.system.states, resting.system.states);
  EXPECT_LT((moving.system.A - resting.system.A).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(resting.system.A.rows(), 4);
}

TEST(Linearize, RefusesAnInstantAfterTheEnd) {
  const Problem problem = loaded(pendulum_urdf(), "duration: 2\n");
  const std::string message =
      refused([&] { linearize_in_motion(*system_of(problem), problem.parameters(), {}, 3.0); });
  EXPECT_NE(message.find("an instant after the end of the run"), std::string::npos) << message;
}

}  // namespace
}  // namespace codesign
