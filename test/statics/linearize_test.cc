// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "statics/linearize.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assembly/assembly.h"
#include "description/study.h"
#include "statics/statics_cases.h"
#include "text/number_text.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

/// Carts on one rail, cart k on cart k - 1 (`carried`) or all on the ground, 1 kg each.
std::string carts(int count, const std::vector<std::string>& dynamics, bool carried = false) {
  std::string urdf =
      R"(<robot name="carts" xmlns:codesign="urn:mechanism_codesign"><link name="ground"/>)";
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k), name = "cart" + number;
    const std::string below = k > 0 && carried ? "cart" + std::to_string(k - 1) : "ground";
    urdf += body(name, 1.0);
    urdf += joint("x" + number, "prismatic", below, name, "0 0 0", "1 0 0",
                  R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)" +
                      dynamics[static_cast<std::size_t>(k)]);
  }
  return urdf + "</robot>";
}

std::string damped(double c) { return "<dynamics damping=\"" + std::to_string(c) + "\"/>"; }
std::string sprung(double k, double d = 0.0) {
  return "<codesign:torsion_spring stiffness=\"" + std::to_string(k) + "\" damping=\"" +
         std::to_string(d) + "\" free_position=\"0\"/>";
}

std::string servo(const std::string& keys, const std::string& number = "0",
                  const std::string& input = "position") {
  return "servo" + number + ": {type: pid, input: x" + number + "/" + input +
         ", setpoint: 0, output: x" + number + ", " + keys + "}";
}
std::string controlled(const std::string& controllers) {
  return "duration: 10\ngravity: [0, 0, 0]\ncontrollers: {" + controllers + "}\n";
}

LinearModel model_of(const std::string& urdf, const std::string& study,
                     const std::vector<std::string>& outputs = {}) {
  const Problem problem = loaded(urdf, study);
  LinearQuestion question;
  question.with_loops = true;
  for (const std::string& output : outputs)
    question.outputs.push_back(parse_signal(output, {}, "outputs"));
  const LinearModel model = linearize_at_rest(*system_of(problem), problem.parameters(), question);
  EXPECT_TRUE(model.status.ok()) << model.status.cause;
  return model;
}

/// Compares poles, one of each pair, whatever their order.
void expect_poles(const LinearModel& model, std::vector<Complex> expected, double tolerance) {
  ASSERT_EQ(model.modes.size(), expected.size());
  for (const LinearMode& mode : model.modes) {
    const auto nearest =
        std::min_element(expected.begin(), expected.end(), [&](const Complex& a, const Complex& b) {
          return std::abs(a - mode.pole.value) < std::abs(b - mode.pole.value);
        });
    EXPECT_LT(std::abs(*nearest - mode.pole.value), tolerance) << mode.pole.value;
    expected.erase(nearest);
  }
}

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
  const LinearModel model = model_of(carts(1, {""}), controlled(servo("gains: {p: 4, d: 2}")));
  expect_poles(model, {{-1.0, std::sqrt(3.0)}}, 1e-12);
  // |4 + 2 j w| = w^2
  const double w = std::sqrt(2.0 + std::sqrt(20.0));
  const LoopMargins& margins = model.loops.at(0).margins;
  EXPECT_NEAR(margins.phase_margin->frequency, w, 1e-9);
  EXPECT_NEAR(margins.phase_margin->value, std::atan(w / 2.0), 1e-9);
  EXPECT_FALSE(margins.gain_margin);
}

TEST(Linearize, AMotorUnderProportionalControl) {
  const LinearModel model = model_of(carts(1, {damped(1.0)}), controlled(servo("gains: {p: 1}")));
  expect_poles(model, {{-0.5, std::sqrt(0.75)}}, 1e-12);
  const double w = std::sqrt(0.5 * (std::sqrt(5.0) - 1.0));
  EXPECT_NEAR(model.loops.at(0).margins.phase_margin->value, std::atan(1.0 / w), 1e-9);
}

// 1/((s + 1)^2 (s + 1)), the last one the lag of the drive.
TEST(Linearize, ThreeLags) {
  const LinearModel model =
      model_of(carts(1, {sprung(1.0, 2.0)}), controlled(servo("gains: {p: 1}, time_constant: 1")));
  const LoopMargins& margins = model.loops.at(0).margins;
  EXPECT_NEAR(margins.gain_margin->value, 8.0, 1e-9);
  EXPECT_NEAR(margins.gain_margin->frequency, std::sqrt(3.0), 1e-9);
  EXPECT_EQ(model.system.states.back(), "servo0/lag");
}

// s^2 (s/6 + 1) + (s/6 + 1) + 10/6 s: (s + 1)(s + 2)(s + 3).
TEST(Linearize, AFilteredDerivative) {
  const LinearModel model =
      model_of(carts(1, {""}), controlled(servo("gains: {p: 1, d: 1.6666666666666667}, "
                                                "derivative_filter: 0.16666666666666666")));
  expect_poles(model, {-1.0, -2.0, -3.0}, 1e-9);
}

// m g l = 9.81: the gain of 20 may fall to 9.81.
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

// The transfer function 2/(s (s + 1)(s + 2)) between zero-order hold and samples of 0.05 s.
TEST(Linearize, ASampledLoopBesideItsGainMargin) {
  const auto sampled = [](double gain, const std::string& more = "") {
    return model_of(carts(1, {damped(1.0)}),
                    controlled(servo("gains: {p: " + std::to_string(gain) +
                                     "}, time_constant: 0.5, sample_time: 0.05" + more)));
  };
  const LinearModel model = sampled(1.0);
  EXPECT_NEAR(model.loops.at(0).margins.gain_margin->value, 2.7928, 5e-5);
  EXPECT_EQ(model.system.period, 0.05);
  EXPECT_EQ(sampled(2.792).stability, Stability::kStable);
  EXPECT_EQ(sampled(2.793).stability, Stability::kUnstable);
  EXPECT_NE(model.verdict.find("samples counted, friction not"), std::string::npos);
  // A further delay of the delay margin brings it to its limit.
  const double delay = model.loops.at(0).margins.delay_margin->value;
  EXPECT_EQ(sampled(1.0, ", delay: " + std::to_string(delay - 1e-4)).stability, Stability::kStable);
  EXPECT_EQ(sampled(1.0, ", delay: " + std::to_string(delay + 1e-4)).stability,
            Stability::kUnstable);
}

// v(k+1) = v(k) - k T v(k): the pole 1 - k T, and with a delay of a sample z^2 - z + k T.
TEST(Linearize, ASampledSpeed) {
  const auto sampled = [](const std::string& more) {
    return model_of(carts(1, {""}),
                    "duration: 10\ncontrollers: {" +
                        servo("gains: {p: 2}, sample_time: 0.1" + more, "0", "velocity") + "}\n");
  };
  const LinearModel model = sampled("");
  EXPECT_NEAR(model.loops.at(0).margins.gain_margin->value, 10.0, 1e-9);
  const LinearModel late = sampled(", delay: 0.1");
  EXPECT_NEAR(late.loops.at(0).margins.gain_margin->value, 5.0, 1e-9);
  std::vector<double> radii;
  for (const LinearMode& mode : late.modes) radii.push_back(mode.pole.radius(0.1));
  std::sort(radii.begin(), radii.end());
  ASSERT_EQ(radii.size(), 3U);
  EXPECT_NEAR(radii[0], 0.5 - std::sqrt(0.05), 1e-12);
  EXPECT_NEAR(radii[1], 0.5 + std::sqrt(0.05), 1e-12);
  EXPECT_NEAR(radii[2], 1.0, 1e-9) << "the position drifts";
  // Three samples of delay: z^3 (z - 1) + k T = 0.
  const LinearModel later = sampled(", delay: 0.3");
  for (const LinearMode& mode : later.modes) {
    const Complex z = std::exp(mode.pole.value * 0.1);
    EXPECT_LT(std::abs((z * z * z * (z - 1.0) + 0.2) * (z - 1.0)), 1e-9);
  }
}

// Deadbeat: after two samples nothing is left.
TEST(Linearize, ADeadbeatLoopHasNoMotionLeft) {
  const LinearModel model =
      model_of(carts(1, {""}),
               "duration: 10\ncontrollers: {c: {type: state_feedback, output: x0, sample_time: "
               "0.5, feedback: "
               "[{signal: x0/position, gain: 4}, {signal: x0/velocity, gain: 3}]}}\n");
  EXPECT_EQ(model.stability, Stability::kStable);
  for (const LinearMode& mode : model.modes) EXPECT_LT(mode.pole.radius(0.5), 1e-6);
}

// Two speeds of their own, sampled every 0.02 s and 0.03 s: (1 - k T)^n over 0.06 s.
TEST(Linearize, SeveralSampleTimes) {
  const LinearModel model =
      model_of(carts(2, {"", ""}),
               controlled(servo("gains: {p: 5}, sample_time: 0.02", "0", "velocity") + ", " +
                          servo("gains: {p: 10}, sample_time: 0.03", "1", "velocity")));
  EXPECT_NEAR(model.system.period, 0.06, 1e-15);
  std::vector<double> radii;
  for (const LinearMode& mode : model.modes) radii.push_back(mode.pole.radius(model.system.period));
  std::sort(radii.begin(), radii.end());
  ASSERT_EQ(radii.size(), 4U);
  EXPECT_NEAR(radii[0], std::pow(0.7, 2), 1e-12);
  EXPECT_NEAR(radii[1], std::pow(0.9, 3), 1e-12);
  EXPECT_EQ(model.loops.at(0).why_not,
            "it samples several times in the common period of all controllers");
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
      model_of(carts(1, {""}), controlled(servo("gains: {p: 4, d: 2}")), {"servo0/error"});
  EXPECT_EQ(
      model.system.inputs,
      (std::vector<std::string>{"servo0/setpoint", "servo0/setpoint_rate", "servo0/disturbance"}));
  EXPECT_NEAR(model.system.B(1, 0), 4.0, 1e-14);
  EXPECT_NEAR(model.system.B(1, 1), 2.0, 1e-14);
  EXPECT_NEAR(model.system.B(1, 2), 1.0, 1e-14);
  EXPECT_NEAR(model.system.D(0, 0), 1.0, 1e-14);
}

/// A shipped case as it is, or with one number of its start changed.
struct Start {
  std::string joint;
  bool of_position = true;
  double change = 0.0;
};

/// The accelerations of coordinates at the assembled start, from the equations that runs use.
std::vector<double> start_accelerations(const Problem& problem, const Start& start,
                                        const std::vector<int>& columns) {
  Study study = study_of(problem);
  const std::vector<double> parameters = problem.parameters();
  const auto is_given = [&](const InitialJointState& initial) {
    return initial.joint == start.joint;
  };
  if (std::none_of(study.initial_state.begin(), study.initial_state.end(), is_given)) {
    study.initial_state.emplace_back();
    study.initial_state.back().joint = start.joint;
  }
  for (InitialJointState& initial : study.initial_state) {
    if (!is_given(initial)) continue;
    std::optional<Quantity>& number = start.of_position ? initial.position : initial.velocity;
    number = Quantity((number ? number->at(parameters) : 0.0) + start.change);
  }
  const Problem changed = with_study(problem, study);
  StartWorkspace workspace(*system_of(changed), parameters);
  const Status status = workspace.solve();
  EXPECT_TRUE(status.ok()) << status.cause;
  std::vector<double> values;
  for (const int column : columns) values.push_back(workspace.state.z[column]);
  return values;
}

int column_of(const CompiledSystem& system, const std::string& joint) {
  const Topology& topology = system.topology();
  for (std::size_t p = 0; p < topology.pairs.size(); ++p)
    for (std::size_t e = 0; e < topology.pairs[p].chain.size(); ++e)
      if (system.robot().joints[to_index(topology.pairs[p].chain[e].joint)].name == joint)
        return system.layout().element_column(static_cast<int>(p), static_cast<int>(e));
  ADD_FAILURE() << joint;
  return 0;
}

/// The derivative of start_accelerations(), by central differences of two steps.
std::vector<double> differences(const Problem& problem, Start start,
                                const std::vector<int>& columns) {
  const auto central = [&](double h) {
    start.change = h;
    std::vector<double> slope = start_accelerations(problem, start, columns);
    start.change = -h;
    const std::vector<double> back = start_accelerations(problem, start, columns);
    for (std::size_t k = 0; k < slope.size(); ++k) slope[k] = (slope[k] - back[k]) / (2.0 * h);
    return slope;
  };
  constexpr double kStep = 2e-4;
  const std::vector<double> wide = central(kStep), near = central(0.5 * kStep);
  std::vector<double> result;
  for (std::size_t k = 0; k < wide.size(); ++k) result.push_back((4.0 * near[k] - wide[k]) / 3.0);
  return result;
}

// Loops, friction that depends on reactions, controllers, all in motion.
TEST(Linearize, ShippedCasesAgreeWithDifferences) {
  for (const std::string name : {"slider_crank", "governor", "two_link_arm", "gantry"}) {
    const Problem problem = load_problem({name + ".urdf", file_text("urdf/" + name + ".urdf")}, {},
                                         {name + ".yaml", file_text("config/" + name + ".yaml")});
    const CompiledSystem& system = *system_of(problem);
    const LinearModel model = linearize_in_motion(system, problem.parameters(), {}, 0.0);
    ASSERT_TRUE(model.status.ok()) << model.status.cause;
    std::vector<std::string> joints;
    std::vector<int> columns;
    for (const std::string& state : model.system.states)
      if (ends_with(state, "/position")) {
        joints.push_back(state.substr(0, state.find('/')));
        columns.push_back(column_of(system, joints.back()));
      }
    const auto count = to_signed(joints.size());
    for (Eigen::Index k = 0; k < 2 * count; ++k) {
      const std::vector<double> expected =
          differences(problem, {joints[to_index(k % count)], k < count}, columns);
      for (Eigen::Index row = 0; row < count; ++row) {
        const double scale =
            1.0 + model.system.A.block(count, 0, count, 2 * count).cwiseAbs().maxCoeff();
        EXPECT_NEAR(model.system.A(count + row, k), expected[to_index(row)], 1e-6 * scale)
            << name << " " << model.system.states[to_index(k)];
      }
    }
  }
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
