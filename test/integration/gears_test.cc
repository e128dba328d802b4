// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gears that lose torque against closed forms: screw, worm, efficiency in both directions, and what
// locks itself; doc/theory.md (9b).
#include <gtest/gtest.h>
#include <cmath>

#include "assembly/make_system.h"
#include "equations/compiled.h"
#include "integration/driven_slides.h"
#include "integration/energy_balance.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

constexpr double kMass = 40.0, kGravity = 9.81, kLoad = kMass * kGravity;

/// A screw with lead angle and friction angle [rad]; its lead is 5 mm, its nut carries 40 kg.
struct Screw {
  double lead_angle, friction_angle;

  double efficiency() const { return std::tan(lead_angle) / std::tan(lead_angle + friction_angle); }
  double backdrive() const { return std::tan(lead_angle - friction_angle) / std::tan(lead_angle); }
  /// Torque at the screw that raises (or, against the load, lowers) the nut with a force f.
  double raising(double f) const { return f * radius() * std::tan(lead_angle + friction_angle); }
  double holding(double f) const { return f * radius() * std::tan(lead_angle - friction_angle); }
  double radius() const { return kLead / (2.0 * M_PI * std::tan(lead_angle)); }

  static constexpr double kLead = 0.005, kInertia = 2e-4;
  static double ratio() { return 2.0 * M_PI / kLead; }

  std::string urdf(const std::string& more = "") const {
    const auto text = [](double x) { return std::to_string(x * 1e6) + "e-6"; };
    return robot(
        "<link name='nut'><inertial><mass value='40'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
        "iyz='0' izz='1'/></inertial></link><joint name='lift' type='prismatic'><parent "
        "link='ground'/><child link='nut'/><axis xyz='0 0 1'/><limit effort='0' "
        "velocity='0.1'/><codesign:actuator gear_ratio='" +
        text(ratio()) + "' rotor_inertia='2e-4' smoothing='1e-6' efficiency='" +
        text(efficiency()) + "' backdrive_efficiency='" + text(backdrive()) + "' " + more +
        "/></joint>");
  }
};

const Screw kSelfLocking{0.06, 0.12}, kFree{0.3, 0.08};

std::string study(double torque, double velocity, const std::string& coordinates) {
  return "duration: 1.0\ngravity: [0, 0, -9.81]\ninitial_state: {lift: {velocity: " +
         std::to_string(velocity) +
         "}}\ncontrollers: {motor: {type: state_feedback, output: lift, feedforward: " +
         std::to_string(torque * Screw::ratio()) + "}}\nsolver: {coordinates: " + coordinates +
         ", relative_tolerance: 1e-10, absolute_tolerance: 1e-12}\n";
}

const char* const kBoth[] = {"joint", "absolute"};

/// Acceleration of the nut at a speed far above the transition.
double acceleration(const Screw& screw, double torque, double velocity, const char* coordinates) {
  const RobotDescription robot = read_urdf({"test.urdf", screw.urdf()});
  const auto system =
      make_system(robot, read_study({"t.yaml", study(torque, velocity, coordinates)}, robot));
  Simulation simulation =
      simulation_of(system, system->parameters(), {parse_signal("lift/acceleration", {}, "t")});
  EXPECT_TRUE(simulation.start().ok());
  Frame frame;
  simulation.sample(0.0, &frame);
  return frame.signals[0];
}

/// Statics of the inclined plane: with these torques the nut neither gains nor loses speed.
TEST(Screw, RaisesAndLowersWithTheTorquesOfTheWedge) {
  for (const char* coordinates : kBoth)
    for (const Screw& screw : {kSelfLocking, kFree}) {
      EXPECT_NEAR(acceleration(screw, screw.raising(kLoad), 0.05, coordinates), 0.0, 1e-4);
      EXPECT_NEAR(acceleration(screw, screw.holding(kLoad), -0.05, coordinates), 0.0, 1e-4);
    }
  EXPECT_LT(kSelfLocking.holding(kLoad), 0.0) << "the motor must help the load down";
  EXPECT_GT(kFree.holding(kLoad), 0.0) << "the motor must brake";
}

TEST(Screw, AcceleratesByWhatItsLossesLeave) {
  const double inertia = Screw::kInertia * Screw::ratio() * Screw::ratio();
  for (const char* coordinates : kBoth)
    for (const Screw& screw : {kSelfLocking, kFree}) {
      const double u = 1.3 * screw.raising(kLoad) * Screw::ratio();
      // m (g + a) = eta (u - n^2 J a)
      const double eta = screw.efficiency(), back = screw.backdrive();
      EXPECT_NEAR(acceleration(screw, u / Screw::ratio(), 0.05, coordinates),
                  (eta * u - kLoad) / (kMass + eta * inertia), 1e-6);
      // Falling without torque: -n^2 J a = eta_b m (g + a)
      EXPECT_NEAR(acceleration(screw, 0.0, -0.05, coordinates),
                  -back * kLoad / (back * kMass + inertia), 1e-6);
    }
}

/// Speed and position after a time, without torque, from rest.
std::vector<double> left_alone(const std::string& urdf, const char* coordinates) {
  const RobotDescription robot = read_urdf({"test.urdf", urdf});
  const auto system =
      make_system(robot, read_study({"t.yaml", study(0.0, 0.0, coordinates)}, robot));
  Simulation simulation = simulation_of(
      system, system->parameters(),
      parsed_signals({"lift/velocity", "lift/position", "lift/gear_torque", "lift/gear_loss"}));
  EXPECT_TRUE(simulation.start().ok());
  const Status status = simulation.advance_to(1.0);
  EXPECT_TRUE(status.ok()) << status.cause;
  Frame frame;
  simulation.sample(1.0, &frame);
  return frame.signals;
}

TEST(Screw, ThatLocksItselfHoldsAndAFreeOneFalls) {
  const double c_d = 1.0 / kSelfLocking.efficiency() - 1.0, c_b = 1.0 - kSelfLocking.backdrive(),
               mean = 0.5 * (c_d + c_b), more = 0.5 * (c_d - c_b);
  // 1 - m mean + m^2 more = 0 with m = |mu|.
  const double mu = std::abs(more) < 1e-12
                        ? 1.0 / mean
                        : (mean - std::sqrt(mean * mean - 4.0 * more)) / (2.0 * more);
  ASSERT_GT(mu, 0.0);
  ASSERT_LT(mu, 1.0);
  for (const char* coordinates : kBoth) {
    const std::vector<double> creeping = left_alone(kSelfLocking.urdf(), coordinates);
    const double v_t = 0.0001;  // a thousandth of the largest speed
    EXPECT_NEAR(creeping[0], -0.25 * v_t * std::atanh(mu), 1e-9) << coordinates;
    EXPECT_NEAR(creeping[2], kLoad, 1e-5 * kLoad) << coordinates;
    EXPECT_NEAR(creeping[3], kLoad, 1e-5 * kLoad) << "all of the load is held by the gear";

    const std::vector<double> stuck =
        left_alone(kSelfLocking.urdf("model='lugre' bristle_stiffness='1e5' bristle_damping='100'"),
                   coordinates);
    EXPECT_NEAR(stuck[0], 0.0, 1e-9) << coordinates;
    EXPECT_NEAR(stuck[3], kLoad, 1e-5 * kLoad) << coordinates;
    EXPECT_LT(stuck[1], -0.5 * mu / 1e5) << "bristles that bear the load";
    EXPECT_GT(stuck[1], -2.0 / 1e5) << "by a few of their lengths";
    EXPECT_LT(left_alone(kFree.urdf(), coordinates)[0], -0.05) << coordinates;
  }
}

/// A worm on a hinge, here with a wheel that a sine turns against gravity on an arm.
std::string worm(double efficiency, double backdrive) {
  return pendulum(
      "<codesign:actuator gear_ratio='40' rotor_inertia='2e-4' smoothing='1e-6' "
      "transition_velocity='0.002' efficiency='" +
      std::to_string(efficiency) + "' backdrive_efficiency='" + std::to_string(backdrive) + "'/>");
}

/// The worst error of the ratio of powers over a run, and how often each direction of power came.
struct Ratios {
  double driving = 0.0, backdriving = 0.0;
  int driven = 0, backdriven = 0;
};

Ratios ratios(double efficiency, double backdrive, const char* coordinates) {
  const RobotDescription robot = read_urdf({"test.urdf", worm(efficiency, backdrive)});
  const Study study = read_study(
      {"t.yaml",
       std::string("duration: 3.0\ninitial_state: {hinge: {velocity: 2.0}}\ncontrollers: {motor: "
                   "{type: state_feedback, output: hinge, feedforward: {type: sine, amplitude: "
                   "6.0, frequency: 0.8}}}\nsolver: {coordinates: ") +
           coordinates + "}\n"},
      robot);
  const auto system = make_system(robot, study);
  Simulation simulation =
      simulation_of(system, system->parameters(),
                    parsed_signals({"hinge/velocity", "hinge/acceleration", "hinge/effort",
                                    "hinge/gear_torque", "hinge/friction_power"}));
  Ratios result;
  const Status status = simulate(&simulation, 3.0, 301, [&](const Frame& frame) {
    const std::vector<double>& s = frame.signals;
    const double motor = (s[2] - 40.0 * 40.0 * 2e-4 * s[1]) * s[0], joint = s[3] * s[0];
    EXPECT_NEAR(s[4], joint - motor, 1e-6 * (1.0 + std::abs(motor))) << "the loss is the rest";
    EXPECT_LE(s[4], 0.0);
    if (std::abs(s[0]) < 0.02 || std::abs(s[3]) < 0.1) return true;
    if (joint > 0.0) {
      ++result.driven;
      result.driving = std::max(result.driving, std::abs(joint / motor - efficiency));
    } else {
      ++result.backdriven;
      result.backdriving = std::max(result.backdriving, std::abs(motor / joint - backdrive));
    }
    return true;
  });
  EXPECT_TRUE(status.ok()) << status.cause;
  return result;
}

TEST(Gear, TheRatioOfPowersIsTheEfficiencyInBothDirections) {
  for (const char* coordinates : kBoth)
    for (const auto& [efficiency, backdrive] :
         {std::pair(0.9, 0.85), std::pair(0.55, 0.2), std::pair(0.4, -0.3), std::pair(1.0, 1.0)}) {
      const Ratios r = ratios(efficiency, backdrive, coordinates);
      EXPECT_LT(r.driving, 1e-6) << coordinates << efficiency;
      EXPECT_LT(r.backdriving, 1e-6) << coordinates << efficiency;
      EXPECT_GT(r.driven, 20) << coordinates << efficiency;
      EXPECT_GT(r.backdriven, 20) << coordinates << efficiency;
    }
}

TEST(Gear, TheEnergyBalanceHoldsWithItsLosses) {
  for (const char* model : {"transition_velocity='0.1'", "bristle_stiffness='1e3' model='lugre'"}) {
    const std::string urdf = double_pendulum(
        "<codesign:actuator gear_ratio='-20' rotor_inertia='1e-4' efficiency='0.8' coulomb='0.002' "
        "viscous='1e-4' " +
        std::string(model) + "/>");
    const Balance b = balance(
        urdf, motion_study(1.0, "{shoulder: {position: 1.0}}", "elbow/velocity", kFriction));
    ASSERT_TRUE(b.status.ok()) << b.status.cause;
    EXPECT_GT(b.friction_work, 0.1);
    EXPECT_NEAR(b.start - b.end, b.friction_work, 1e-5 * b.friction_work) << model;
  }
}

TEST(MotorFriction, CountsAtTheJointByTheRatio) {
  // A motor's 0.01 N m and 2e-4 N m s/rad behind 1:30 at 2 rad/s.
  const std::string urdf = pendulum(
      "<codesign:actuator gear_ratio='-30' rotor_inertia='1e-4' coulomb='0.01' viscous='2e-4'/>");
  Compiled c(urdf, let_go("{hinge: {velocity: 2.0}}", "hinge/velocity"));
  ASSERT_TRUE(c.start().ok());
  c.equations.formulas().load(c.state);
  EXPECT_NEAR(c.equations.formulas().friction(0, 0).load, 0.3 + 900.0 * 2e-4 * 2.0, 1e-12);
}

}  // namespace
}  // namespace codesign
