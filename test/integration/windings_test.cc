// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// DC motors by resistance, inductance and torque constant, against closed forms and an independent
// integration; doc/theory.md (9d).
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "integration/driven_slides.h"
#include "integration/energy_balance.h"

namespace codesign {
namespace {

const char* const kWindingCoordinates[] = {"joint", "absolute"};
constexpr double kWindingR = 0.5, kWindingL = 0.01, kWindingK = 0.04, kWindingN = 50.0;
// A rotor of 50^2 * 2e-5 and a load, together 0.1: kg m^2, or kg on a slide.
constexpr double kWoundInertia = 0.1;

std::string wound_axis(const std::string& type, const std::string& winding,
                       const std::string& load = "0.05") {
  return robot("<link name='load'><inertial><mass value='" + load + "'/><inertia ixx='" + load +
               "' ixy='0' ixz='0' iyy='" + load + "' iyz='0' izz='" + load +
               "'/></inertial></link><joint name='axis' type='" + type +
               "'><parent link='ground'/><child link='load'/><axis xyz='0 0 1'/><limit effort='5' "
               "velocity='0' lower='-99' upper='99'/><codesign:actuator gear_ratio='50' "
               "rotor_inertia='2e-5' resistance='0.5' torque_constant='0.04' " +
               winding + "/></joint>");
}

std::string wound_study(const std::string& more, const std::string& coordinates = "joint") {
  return "duration: 1.0\ngravity: [0, 0, 0]\n" + more +
         "\nsolver: {method: rodas5p, relative_tolerance: 1.0e-12, absolute_tolerance: 1.0e-14, "
         "coordinates: " +
         coordinates + "}\n";
}

std::string supply_of(const std::string& function) {
  return "controllers: {supply: {type: state_feedback, output: axis, feedforward: " + function +
         "}}";
}

/// Speed and current of J w' = n K i, L i' = u - R i - K n w from (0, i_0), by the eigenvalues.
std::pair<double, double> winding_step(double u, double i_0, double t) {
  using Complex = std::complex<double>;
  const double nK = kWindingN * kWindingK;
  const Complex root = std::sqrt(Complex(kWindingR * kWindingR / (4.0 * kWindingL * kWindingL) -
                                         nK * nK / (kWoundInertia * kWindingL))),
                p = -kWindingR / (2.0 * kWindingL) + root,
                q = -kWindingR / (2.0 * kWindingL) - root;
  // w = u/nK + a e^pt + b e^qt with w(0) = 0, w'(0) = nK i_0 / J.
  const double rate = nK * i_0 / kWoundInertia, final = u / nK;
  const Complex a = (rate + q * final) / (p - q), b = -final - a;
  const Complex w = final + a * std::exp(p * t) + b * std::exp(q * t),
                w_rate = a * p * std::exp(p * t) + b * q * std::exp(q * t);
  return {w.real(), w_rate.real() * kWoundInertia / nK};
}

TEST(Winding, FollowsAStepOfTheVoltage) {
  const double u = 6.0, i_0 = 1.5;
  for (const char* type : {"continuous", "prismatic"})
    for (const char* coordinates : kWindingCoordinates)
      for (const double t : {0.004, 0.03, 0.2}) {
        const std::vector<double> y = end_of(
            wound_axis(type, "inductance='0.01'"),
            wound_study(supply_of("6.0") + "\ninitial_state: {axis: {position: 0, current: 1.5}}",
                        coordinates),
            t,
            {"axis/velocity", "axis/current", "axis/effort", "axis/voltage",
             "axis/electrical_power", "axis/copper_loss", "axis/effort_rate", "axis/motor_torque",
             "axis/actuator_power", "mechanism/electrical_power", "mechanism/copper_loss",
             "mechanism/magnetic_energy"});
        const auto [w, i] = winding_step(u, i_0, t);
        EXPECT_NEAR(y[0], w, 1e-10) << type << coordinates << t;
        EXPECT_NEAR(y[1], i, 1e-9);
        EXPECT_NEAR(y[2], kWindingN * kWindingK * i, 1e-8);
        EXPECT_NEAR(y[3], u, 1e-14);
        EXPECT_NEAR(y[4], u * i, 1e-8);
        EXPECT_NEAR(y[5], kWindingR * i * i, 1e-8);
        EXPECT_NEAR(
            y[6],
            kWindingN * kWindingK * (u - kWindingR * i - kWindingK * kWindingN * w) / kWindingL,
            1e-6);
        EXPECT_NEAR(y[7], kWindingK * i, 1e-10);
        EXPECT_NEAR(y[8], kWindingN * kWindingK * i * w, 1e-8);
        EXPECT_NEAR(y[9], u * i, 1e-8);
        EXPECT_NEAR(y[10], kWindingR * i * i, 1e-8);
        EXPECT_NEAR(y[11], 0.5 * kWindingL * i * i, 1e-9);
      }
}

TEST(Winding, WithoutInductanceTheCurrentFollowsAtOnce) {
  const double u = 6.0, nK = kWindingN * kWindingK, decay = nK * nK / (kWindingR * kWoundInertia);
  for (const char* coordinates : kWindingCoordinates) {
    const double t = 0.02, w = u / nK * (1.0 - std::exp(-decay * t)), i = (u - nK * w) / kWindingR;
    const std::vector<double> y =
        end_of(wound_axis("continuous", ""), wound_study(supply_of("6.0"), coordinates), t,
               {"axis/velocity", "axis/current", "axis/effort_rate", "mechanism/magnetic_energy"});
    EXPECT_NEAR(y[0], w, 1e-10) << coordinates;
    EXPECT_NEAR(y[1], i, 1e-9);
    EXPECT_NEAR(y[2], -nK * nK / kWindingR * nK * i / kWoundInertia, 1e-6);
    EXPECT_EQ(y[3], 0.0);
  }
}

// A rotor that the load holds: u/R (1 - exp(-R t/L)), the stall current at the end.
TEST(Winding, StallsAtTheVoltageOverTheResistance) {
  const std::string held = wound_axis("continuous", "inductance='0.01'", "1e12");
  for (const double t : {0.01, 0.05, 0.9}) {
    const std::vector<double> y = end_of(held, wound_study(supply_of("-6.0")), t, {"axis/current"});
    EXPECT_NEAR(y[0], -12.0 * (1.0 - std::exp(-kWindingR / kWindingL * t)), 1e-8) << t;
  }
}

// Without a controller the winding is closed, and brakes.
TEST(Winding, ClosedItBrakes) {
  const double t = 0.01,
               decay = kWindingN * kWindingN * kWindingK * kWindingK / (kWindingR * kWoundInertia);
  const std::vector<double> y =
      end_of(wound_axis("continuous", ""),
             wound_study("initial_state: {axis: {position: 0, velocity: 3}}"), t,
             {"axis/velocity", "axis/voltage", "axis/electrical_power"});
  EXPECT_NEAR(y[0], 3.0 * std::exp(-decay * t), 1e-10);
  EXPECT_EQ(y[1], 0.0);
  EXPECT_EQ(y[2], 0.0);
}

// From scipy.integrate.solve_ivp (DOP853, rtol 1e-13, atol 1e-15) of
//   theta'' = n K i/J, i' = (u - R i - K n theta')/L, q' = R i^2, u = s/(1 + (s/24)^8)^(1/8), s =
//   60 (1 - theta) - 4 theta'.
TEST(Winding, WithinItsBusAgreesWithAnIndependentIntegration) {
  const struct {
    double t, position, velocity, current, voltage;
  } expected[] = {{0.02, 0.0471317089849, 6.22933956161, 22.9393073022, 23.7320948779},
                  {0.1, 0.595543866939, 5.2550037953, -2.91121866949, 3.24735275687},
                  {0.3, 0.949481977254, 0.511675164304, -0.343676188572, 0.984380707562}};
  const std::string servo =
      "controllers: {servo: {type: pid, input: axis/position, setpoint: 1.0, output: axis, gains: "
      "{p: 60.0, d: 4.0}}}\nlimits: {effort: true}";
  for (const char* coordinates : kWindingCoordinates)
    for (const auto& at : expected) {
      const std::vector<double> y = end_of(
          wound_axis("continuous", "inductance='0.01' bus_voltage='24'"),
          wound_study(servo, coordinates), at.t,
          {"axis/position", "axis/velocity", "axis/current", "axis/voltage", "servo/output"});
      EXPECT_NEAR(y[0], at.position, 1e-10) << coordinates << at.t;
      EXPECT_NEAR(y[1], at.velocity, 1e-9);
      EXPECT_NEAR(y[2], at.current, 1e-8);
      EXPECT_NEAR(y[3], at.voltage, 1e-8);
      EXPECT_NEAR(y[4], 60.0 * (1.0 - at.position) - 4.0 * at.velocity, 1e-8);
    }
}

// Behind an elastic gear the winding turns with the motor: a load of 1e9 holds the joint, and the
// motor comes to rest on the spring.
TEST(Winding, TurnsWithTheMotorOfAnElasticGear) {
  const std::vector<double> y =
      end_of(wound_axis("continuous", "inductance='0.01' stiffness='40' damping='2'", "1e9"),
             "duration: 20.0\ngravity: [0, 0, 0]\n" + supply_of("3.0"), 20.0,
             {"axis/current", "axis/effort", "axis/gear_deflection", "axis/gear_torque"});
  EXPECT_NEAR(y[0], 6.0, 1e-6);
  EXPECT_NEAR(y[1], 12.0, 1e-5);
  EXPECT_NEAR(y[2], 12.0 / 40.0, 1e-6);
  EXPECT_NEAR(y[3], 12.0, 1e-5);
}

// Where the motion is given, the effort tells the current: J a = n K i.
TEST(Winding, OfAGivenMotionHasTheCurrentThatTheMotionNeeds) {
  const double w = 0.3 * 2.0 * M_PI, t = 0.4, a = -0.5 * w * w * std::sin(w * t),
               speed = 0.5 * w * std::cos(w * t), i = kWoundInertia * a / (kWindingN * kWindingK);
  const std::vector<double> y = end_of(
      wound_axis("continuous", "inductance='0.01' bus_voltage='1'"),
      wound_study("motion: {axis: {position: {type: sine, amplitude: 0.5, frequency: 0.3}}}"), t,
      {"axis/current", "axis/voltage", "axis/copper_loss", "axis/electrical_power",
       "mechanism/copper_loss"});
  EXPECT_NEAR(y[0], i, 1e-10);
  EXPECT_NEAR(y[1], kWindingR * i + kWindingK * kWindingN * speed, 1e-10);
  EXPECT_NEAR(y[2], kWindingR * i * i, 1e-10);
  EXPECT_NEAR(y[3], (kWindingR * i + kWindingK * kWindingN * speed) * i, 1e-10);
  EXPECT_NEAR(y[4], kWindingR * i * i, 1e-10);
}

// The supply gives what the winding heats, what its field holds, and what drives the mechanism:
// integrals by Simpson's rule over samples of a run.
TEST(Winding, ItsEnergiesAreInBalance) {
  const auto system = compile(
      robot(bar("arm") +
            hinge("axis", "ground", "arm", "0 0 0",
                  "<codesign:actuator gear_ratio='50' rotor_inertia='2e-5' resistance='0.5' "
                  "inductance='0.01' torque_constant='0.04' bus_voltage='24' efficiency='0.8'/>")),
      "duration: 1.0\ncontrollers: {servo: {type: pid, input: axis/position, setpoint: 1.0, "
      "output: axis, gains: {p: 60.0, d: 4.0}}}\nsolver: {method: rodas5p, relative_tolerance: "
      "1.0e-12, absolute_tolerance: 1.0e-14}\n");
  Simulation run =
      simulation_of(system, system->parameters(),
                    parsed_signals({"mechanism/electrical_power", "mechanism/copper_loss",
                                    "mechanism/actuator_power", "mechanism/friction_power",
                                    "mechanism/magnetic_energy", "mechanism/total_energy"}));
  ASSERT_TRUE(run.start().ok());
  constexpr int kSteps = 4000;
  double sums[4] = {};
  Frame frame;
  std::vector<double> first, last;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    if (k > 0) {
      ASSERT_TRUE(run.advance_to(t).ok());
    }
    run.sample(t, &frame);
    if (k == 0) first = frame.signals;
    last = frame.signals;
    const double weight = (k == 0 || k == kSteps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / (3.0 * kSteps);
    for (std::size_t s = 0; s < 4; ++s) sums[s] += weight * frame.signals[s];
  }
  EXPECT_GT(sums[1], 1.0);
  EXPECT_NEAR(sums[0], sums[1] + sums[2] + last[4] - first[4], 1e-6 * sums[0]);
  EXPECT_NEAR(last[5] - first[5], sums[2] + sums[3], 1e-5 * sums[0]);
}

TEST(Winding, RefusesWhatItCannotMean) {
  const auto fault = [](const std::string& urdf, const std::string& text) {
    try {
      compile(urdf, text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_NE(
      fault(wound_axis("continuous", ""),
            wound_study("controllers: {servo: {type: pd_gravity, setpoint: 0.0, output: axis, "
                        "gains: {p: 1.0}}}"))
          .find("the law computes an effort, and the motor of the joint is moved by a voltage"),
      std::string::npos);
  EXPECT_NE(fault(wound_axis("continuous", ""),
                  wound_study(supply_of("1.0") +
                              "\nmotion: {axis: {position: {type: sine, amplitude: 0.5, "
                              "frequency: 0.3}}}"))
                .find("so that the controller \"supply\", which drives it, has no effect"),
            std::string::npos);
  EXPECT_NE(
      fault(wound_axis("continuous", ""), wound_study("initial_state: {axis: {current: 1.0}}"))
          .find("the motor of the joint has no inductance"),
      std::string::npos);
  EXPECT_NE(
      fault(wound_axis("continuous", ""),
            wound_study("controllers: {servo: {type: pid, input: axis/current, setpoint: 0.0, "
                        "output: axis, gains: {p: 1.0}}}"))
          .find("a controller cannot read an effort"),
      std::string::npos);
}

}  // namespace
}  // namespace codesign
