// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "linear/sliding_friction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/equilibrium.h"
#include "mechanism_codesign/error.h"
#include "statics/linear_cases.h"

namespace codesign {
namespace {

LinearModel sliding(const std::string& urdf, const std::string& study,
                    LinearFriction friction = LinearFriction::kGivenSpeed) {
  const Problem problem = loaded(urdf, study);
  LinearQuestion question;
  question.friction = friction;
  const Equilibrium found =
      find_equilibrium(*system_of(problem), problem.parameters(), {}, nullptr, question);
  EXPECT_TRUE(found.status.ok()) << found.status.cause;
  return found.linear;
}

std::string start(double speed, const std::string& joint = "x0") {
  return "initial_state: {" + joint + ": {velocity: " + std::to_string(speed) + "}}\n";
}

/// The damping of a cart of 1 kg on a spring of 4 N/m is minus the sum of its poles.
double damping_of(const LinearModel& model) {
  double sum = 0.0, product = 1.0;
  for (const LinearMode& mode : model.modes) {
    sum += (mode.pole.is_pair ? 2.0 : 1.0) * mode.pole.growth();
    product *= mode.pole.is_pair ? std::norm(mode.pole.value) : mode.pole.growth();
  }
  EXPECT_NEAR(product, 4.0, 1e-6);
  return -sum;
}

// S = (T_c + (T_s - T_c) exp(-(v/v_s)^2)) tanh(4 v/v_t) + c v: it falls with the speed.
TEST(SlidingFriction, OfStribecksCurve) {
  const double coulomb = 2.0, held = 3.0, v_s = 0.1, v_t = 0.005, viscous = 0.3, spring = 0.4;
  const std::string urdf = carts(
      1,
      {sprung(4.0, spring) +
       R"(<codesign:friction model="stribeck" coulomb="2" static="3" stribeck_velocity="0.1" transition_velocity="0.005" viscous="0.3"/>)"});
  for (const double v : {0.02, -0.05, 0.3}) {
    const double more = (held - coulomb) * std::exp(-v * v / (v_s * v_s)),
                 turn = std::tanh(4.0 * v / v_t);
    const double slope = viscous - 2.0 * v / (v_s * v_s) * more * turn +
                         (coulomb + more) * 4.0 / v_t * (1.0 - turn * turn);
    const LinearModel model = sliding(urdf, controlled("") + start(v));
    EXPECT_NEAR(damping_of(model), spring + slope, 1e-8 * (1.0 + std::abs(slope))) << v;
    EXPECT_EQ(model.stability, spring + slope < 0.0 ? Stability::kUnstable : Stability::kStable);
    EXPECT_EQ(model.verdict.substr(model.verdict.find(';')),
              "; damping, controllers and friction at the given speed counted");
  }
}

// Steady sliding of LuGre's bristles: g(v).
TEST(SlidingFriction, OfBristles) {
  const std::string urdf = carts(
      1,
      {sprung(4.0, 0.0) +
       R"(<codesign:friction model="lugre" coulomb="2" static="3" transition_velocity="0.1"/>)"});
  const double v = 0.08;
  EXPECT_NEAR(damping_of(sliding(urdf, controlled("") + start(v))),
              -2.0 * v / 0.01 * std::exp(-v * v / 0.01), 1e-8);
}

// mu N on a rail that carries 1 kg.
TEST(SlidingFriction, WithTheNormalForceOfThePosture) {
  const std::string urdf = carts(
      1,
      {sprung(4.0, 0.0) +
       R"(<codesign:friction mu_static="0.4" mu_dynamic="0.2" transition_velocity="0.01" joint_length="0.1" joint_width="0.1" smoothing="1e-9"/>)"});
  const std::string study = "duration: 10\n" + start(0.015);
  const double v_t = 0.01, u = 1.5, d = 0.25 * u * u + 0.75, turn = std::tanh(4.0 * u);
  const double slope =
      (4.0 * 0.2 * (1.0 - turn * turn) + 0.2 * (1.0 / (d * d) - u * u / (d * d * d))) / v_t;
  EXPECT_NEAR(damping_of(sliding(urdf, study)), kGravity * slope,
              1e-6 * kGravity * std::abs(slope));
}

// The crank turns at 2 rad/s; the slider's friction counts with its own speed there.
TEST(SlidingFriction, OfADependentJoint) {
  const double sine = std::sin(0.7), cosine = std::cos(0.7),
               root = std::sqrt(0.09 - 0.01 * sine * sine);
  const std::string urdf = planar_slider_crank(
      "<codesign:torsion_spring stiffness=\"200\" damping=\"0\" free_position=\"" +
      std::to_string(0.1 * cosine + root) +
      R"("/><codesign:friction model="stribeck" coulomb="1" static="2" stribeck_velocity="0.2" transition_velocity="0.001"/>)");
  const LinearModel model = sliding(
      urdf,
      "duration: 10\ngravity: [0, 0, 0]\ninitial_state: {crank_joint: {position: 0.7, velocity: "
      "2}, slider_joint: {guess: 0.35}}\n");
  const double by_crank = -0.1 * sine - 0.01 * sine * cosine / root;
  const double v = 2.0 * by_crank;
  const double slope = -2.0 * std::abs(v) / 0.04 * std::exp(-v * v / 0.04);
  const double mass = 0.01 + by_crank * by_crank;
  ASSERT_EQ(model.modes.size(), 1U);
  EXPECT_NEAR(-2.0 * model.modes[0].pole.growth(), slope * by_crank * by_crank / mass, 1e-5);
}

// Losses of a gear: mu (c_d |tau|) of the torque that holds a weight, and coulomb friction.
TEST(SlidingFriction, OfGears) {
  const std::string urdf = carts(
      1,
      {sprung(4.0, 0.5) +
       R"(<codesign:actuator gear_ratio="10" rotor_inertia="0" coulomb="0.3" viscous="0.002" efficiency="0.8" transition_velocity="0.1" smoothing="1e-9"/>)"});
  const double v = 0.05, turn = std::tanh(4.0 * v / 0.1);
  const std::string study =
      controlled("hold: {type: state_feedback, output: x0, feedforward: 6}") + start(v);
  // tau = 6 N drives: mu c_d tau with c_d = 1/0.8 - 1, c_b = 1 - eta_b = c_d of the default.
  const double by_mu = 10.0 * 0.3 + 0.25 * 6.0;
  const double slope = 4.0 / 0.1 * (1.0 - turn * turn) * by_mu;
  const LinearModel model = sliding(urdf, study);
  const double damping = 0.5 + 100.0 * 0.002 + slope;
  // s^2 + damping s + 4
  for (const LinearMode& mode : model.modes) {
    const std::complex<double> s = mode.pole.value;
    EXPECT_LT(std::abs(s * s + damping * s + 4.0), 1e-7 * damping * std::abs(s)) << s;
  }
}

// Of bristles in a gear: those of no losses are no states, whose poles would be zero.
TEST(SlidingFriction, OfBristlesInGears) {
  const std::string urdf = carts(
      1, {sprung(4.0, 0.5) +
          R"(<codesign:actuator gear_ratio="10" rotor_inertia="0" coulomb="0.3" model="lugre"/>)"});
  const std::string study = controlled("") + start(0.05);
  for (const LinearFriction friction : {LinearFriction::kOff, LinearFriction::kGivenSpeed}) {
    const LinearModel model = sliding(urdf, study, friction);
    EXPECT_EQ(model.stability, Stability::kStable) << model.verdict;
    EXPECT_NEAR(damping_of(model), 0.5, 1e-8);
  }
}

constexpr double kStiffness = 50.0, kDamper = 0.7;

/// An elastic gear of ratio 10 with a rotor of 0.2 kg at the joint of a cart. @param losses of it.
std::string elastic_cart(const std::string& losses) {
  return carts(
      1,
      {sprung(4.0, 0.5) +
       R"(<codesign:actuator gear_ratio="10" rotor_inertia="0.002" stiffness="50" damping="0.7" )" +
       losses + "/>"});
}

/// |det| of the cart and its motor at s, per size of its terms. @param motor_damping at the joint.
double rest_of(const std::complex<double>& s, double motor_damping) {
  const std::complex<double> gear = kStiffness + kDamper * s, cart = s * s + 0.5 * s + 4.0 + gear,
                             motor = 0.2 * s * s + motor_damping * s + gear;
  const double size = 0.2 * std::norm(s) + motor_damping * std::abs(s) + std::abs(gear);
  return std::abs(cart * motor - gear * gear) / (std::abs(cart) * size + std::norm(gear));
}

// The motor moves with its joint, and its losses are damping of the motor: of the torque of the
// spring and of coulomb friction, which falls with the speed or rises.
TEST(SlidingFriction, OfElasticGears) {
  const double v = 0.05, turn = std::tanh(4.0 * v / 0.1), torque = 6.0;
  const double slope = 4.0 / 0.1 * (1.0 - turn * turn) * (10.0 * 0.3 + 0.25 * torque);
  const std::string study =
      controlled("hold: {type: state_feedback, output: x0, feedforward: 6}") + start(v);
  const LinearModel model = sliding(
      elastic_cart(
          R"(coulomb="0.3" viscous="0.002" efficiency="0.8" transition_velocity="0.1" smoothing="1e-9")"),
      study);
  ASSERT_EQ(model.modes.size(), 3U);
  for (const LinearMode& mode : model.modes)
    EXPECT_LT(rest_of(mode.pole.value, 0.2 + slope), 1e-8) << mode.pole.value;
  EXPECT_EQ(model.verdict.substr(model.verdict.find(';')),
            "; damping, controllers and friction at the given speed counted");
}

// The friction of a cylinder acts along its turn and its slide: all of it counts at rest.
TEST(SlidingFriction, CountsCylindersAtRestAndSaysSo) {
  const std::string pin =
      R"(<codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.01" joint_length="0.1" pin_radius="0.02" preload="2"/>)";
  const std::string dry = R"(<dynamics damping="0" friction="0.4"/>)";
  const std::string ends = "</robot>";
  const auto with = [&](std::string urdf, const std::string& more) {
    return urdf.replace(urdf.rfind(ends), ends.size(), more + ends);
  };
  const auto folded = [&](const std::string& of_turn, const std::string& of_slide) {
    return with(carts(1, {sprung(4.0)}),
                R"(<link name="sleeve"/>)" + body("rod", 1.0) +
                    joint("turn", "continuous", "ground", "sleeve", "0 0 0", "1 0 0", of_turn) +
                    joint("slide", "prismatic", "sleeve", "rod", "0 0 0", "1 0 0",
                          R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)" + of_slide));
  };
  // The cart with friction of its own pulls a rod through a sleeve.
  const std::string loop = with(
      carts(1, {sprung(4.0) + dry}),
      body("rod", 1.0) + joint("free", "floating", "ground", "rod", "0 0 0", "1 0 0") +
          R"(<loop name="sleeve" type="codesign:cylindrical"><predecessor link="ground"/><successor link="rod"/><axis xyz="1 0 0"/>)" +
          pin +
          R"(</loop><loop name="pull" type="codesign:distance"><predecessor link="cart0"><origin xyz="-1 0 0"/></predecessor><successor link="rod"/><codesign:length value="1"/></loop>)");
  struct Case {
    std::string urdf, moving, counted;
  };
  const std::string as_at_rest = "; damping, controllers and friction as at rest counted";
  for (const Case& c :
       {Case{folded(pin, ""), "slide", as_at_rest}, Case{folded("", pin), "turn", as_at_rest},
        Case{folded(pin, dry), "slide", as_at_rest},
        Case{loop, "x0",
             "; damping, controllers and friction at the given speed (as at rest: sleeve) "
             "counted"}}) {
    const std::string study = controlled("") + start(0.02, c.moving);
    const LinearModel model = sliding(c.urdf, study);
    EXPECT_EQ(model.verdict.substr(model.verdict.find(';')), c.counted);
    if (c.counted != as_at_rest) continue;
    const LinearModel at_rest = sliding(c.urdf, study, LinearFriction::kRegularised);
    std::vector<std::complex<double>> poles;
    for (const LinearMode& mode : at_rest.modes) poles.push_back(mode.pole.value);
    expect_poles(model, poles, 1e-9);
  }
}

// Of a table, which slips in any direction, with friction of one of its slides beside.
TEST(SlidingFriction, KeepsTheFrictionOfContacts) {
  const auto table = [](const std::string& more) {
    const std::string limit = R"(<limit lower="0" upper="0" effort="0" velocity="0"/>)";
    return R"(<robot name="table" xmlns:codesign="urn:mechanism_codesign"><link name="ground"/><link name="between"/>)" +
           body("plate", 1.0) +
           joint(
               "along", "prismatic", "ground", "between", "0 0 0", "1 0 0",
               limit + more +
                   R"(<codesign:friction mu_static="0.3" mu_dynamic="0.2" transition_velocity="0.01"/>)") +
           joint("across", "prismatic", "between", "plate", "0 0 0", "0 1 0", limit) + "</robot>";
  };
  // T tanh(4 v/v_t)
  const double v = 0.005, turn = std::tanh(4.0 * v / 0.01),
               slope = 0.4 * 4.0 / 0.01 * (1.0 - turn * turn);
  const std::string study = "duration: 10\n" + start(v, "along");
  const LinearModel model = sliding(table(R"(<dynamics damping="0" friction="0.4"/>)"), study);
  const LinearModel at_rest =
      sliding(table("<dynamics damping=\"" + std::to_string(slope) + "\"/>"), study,
              LinearFriction::kRegularised);
  std::vector<std::complex<double>> poles;
  for (const LinearMode& mode : at_rest.modes) poles.push_back(mode.pole.value);
  expect_poles(model, poles, 1e-4);
  EXPECT_EQ(model.verdict.substr(model.verdict.find(';')),
            "; damping, controllers and friction at the given speed (as at rest: along) counted");
}

TEST(SlidingFriction, AsksForASpeed) {
  EXPECT_THROW(sliding(carts(1, {damped(1.0)}), controlled("")), InputError);
}

}  // namespace
}  // namespace codesign
