// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Inertias of joint coordinates alone, against closed forms; doc/theory.md (9e).
#include <gtest/gtest.h>

#include <cmath>

#include "integration/driven_slides.h"
#include "integration/energy_balance.h"

namespace codesign {
namespace {

const char* const kArmatureCoordinates[] = {"joint", "absolute"};
constexpr double kArmature = 0.4, kSwungInertia = 0.0834, kSwungCentre = 0.5;

/// Two bars; more stands in the elbow.
std::string two_bars(const std::string& more) {
  return robot(bar("upper") + bar("lower") + hinge("shoulder", "ground", "upper", "0 0 0") +
               hinge("elbow", "upper", "lower", "0 0 -1", more));
}

std::string two_bar_study(const std::string& more, const std::string& coordinates) {
  return "duration: 1.0\ngravity: [0, 0, 0]\ninitial_state: {shoulder: {position: 0.3, velocity: "
         "1.5}, elbow: {position: 0.8, velocity: -2.0}}\n" +
         more +
         "\nsolver: {method: rodas5p, relative_tolerance: 1.0e-11, absolute_tolerance: 1.0e-13, "
         "coordinates: " +
         coordinates + "}\n";
}

struct BarAccelerations {
  double shoulder, elbow;
};

/// (M + diag(0, a)) q'' = tau - c of two bars, both velocities as in two_bar_study().
BarAccelerations bar_accelerations(double a, double tau_shoulder, double tau_elbow) {
  const double cosine = std::cos(0.8), sine = std::sin(0.8), q1 = 1.5, q2 = -2.0;
  const double outer = kSwungInertia + kSwungCentre * kSwungCentre, m22 = outer + a,
               m12 = outer + kSwungCentre * cosine,
               m11 = kSwungInertia + kSwungCentre * kSwungCentre + 1.0 + outer +
                     2.0 * kSwungCentre * cosine;
  const double h = kSwungCentre * sine, c1 = -h * (2.0 * q1 * q2 + q2 * q2), c2 = h * q1 * q1;
  const double r1 = tau_shoulder - c1, r2 = tau_elbow - c2, det = m11 * m22 - m12 * m12;
  return {(m22 * r1 - m12 * r2) / det, (m11 * r2 - m12 * r1) / det};
}

TEST(Armature, AddsToTheDiagonalOfTheMassMatrix) {
  for (const char* more :
       {"<codesign:actuator armature='0.4'/>", "<dynamics damping='0' armature='0.4'/>",
        "<dynamics damping='0' armature='7'/><codesign:actuator armature='0.4' "
        "rotor_inertia='0'/>"})
    for (const char* coordinates : kArmatureCoordinates) {
      const std::vector<double> y = end_of(
          two_bars(more),
          two_bar_study("loads: [{joint: shoulder, effort: 2.0}, {joint: elbow, effort: -1.0}]",
                        coordinates),
          0.0, {"shoulder/acceleration", "elbow/acceleration", "mechanism/kinetic_energy"});
      const BarAccelerations a = bar_accelerations(kArmature, 2.0, -1.0);
      EXPECT_NEAR(y[0], a.shoulder, 1e-11) << more << coordinates;
      EXPECT_NEAR(y[1], a.elbow, 1e-11);
      const std::vector<double> without =
          end_of(two_bars(""), two_bar_study("", coordinates), 0.0, {"mechanism/kinetic_energy"});
      EXPECT_NEAR(y[2] - without[0], 0.5 * kArmature * 4.0, 1e-12);
    }
}

// n J_r of a rotor with n^2 J_r = a vanishes with a large ratio, and all else with it; a rotor of
// ratio 1 is another thing.
TEST(Armature, IsTheRotorOfALargeRatio) {
  const auto end = [](const std::string& actuator) {
    return end_of(two_bars("<codesign:actuator " + actuator + "/>"), two_bar_study("", "joint"),
                  1.0, {"shoulder/position", "elbow/position"});
  };
  const std::vector<double> armature = end("armature='0.4'"),
                            fast = end("gear_ratio='1e7' rotor_inertia='4e-15'"),
                            direct = end("gear_ratio='1' rotor_inertia='0.4'");
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(armature[k], fast[k], 1e-6) << k;
    EXPECT_GT(std::abs(armature[k] - direct[k]), 1e-2) << k;
  }
}

TEST(Armature, KeepsTheEnergyAndShakesNothing) {
  const std::string text = two_bar_study("", "joint");
  const Balance run = balance(two_bars("<codesign:actuator armature='0.4'/>"),
                              "duration: 2.0\ninitial_state: {elbow: {position: 1.0}}\nsolver: " +
                                  std::string(kTight) + "\n");
  ASSERT_TRUE(run.status.ok()) << run.status.cause;
  EXPECT_LT(run.largest_drift, 1e-8);
  // Of a link on the ground: the moment is that of the link alone.
  const std::string one = robot(
      bar("arm") + hinge("axis", "ground", "arm", "0 0 0", "<codesign:actuator armature='0.4'/>"));
  const std::vector<double> y =
      end_of(one, "duration: 1.0\ngravity: [0, 0, 0]\nloads: [{joint: axis, effort: 3.0}]\n", 0.0,
             {"axis/acceleration", "mechanism/shaking_moment/y", "axis/reaction_torque/y"});
  const double link = kSwungInertia + kSwungCentre * kSwungCentre;
  EXPECT_NEAR(y[0], 3.0 / (link + kArmature), 1e-12);
  EXPECT_NEAR(y[1], -link * y[0], 1e-12);
  EXPECT_NEAR(std::abs(y[2]), link * y[0], 1e-12) << "what reaches the child";
}

TEST(Armature, IsPartOfInverseDynamics) {
  const double t = 0.4, w = 2.0 * M_PI * 0.3, a = -0.5 * w * w * std::sin(w * t);
  const std::string one = robot(bar("arm") + hinge("axis", "ground", "arm", "0 0 0",
                                                   "<dynamics damping='0' armature='0.4'/>"));
  const std::string motion = "{type: sine, amplitude: 0.5, frequency: 0.3}";
  const double needed = (kSwungInertia + kSwungCentre * kSwungCentre + kArmature) * a;
  const std::vector<double> given =
      end_of(one, "duration: 1.0\ngravity: [0, 0, 0]\nmotion: {axis: {position: " + motion + "}}\n",
             t, {"axis/effort"});
  EXPECT_NEAR(given[0], needed, 1e-11);
  const std::vector<double> torque = end_of(
      two_bars("<codesign:actuator armature='0.4'/>"),
      two_bar_study(
          "controllers: {one: {type: computed_torque, output: shoulder, setpoint: 0.3, gains: "
          "{p: 4.0, d: 1.0}}, two: {type: computed_torque, output: elbow, setpoint: 0.1, gains: "
          "{p: 9.0, d: 2.0}}}",
          "joint"),
      0.0, {"shoulder/acceleration", "elbow/acceleration"});
  EXPECT_NEAR(torque[0], -1.5, 1e-11) << "what computed torque demands";
  EXPECT_NEAR(torque[1], 9.0 * -0.7 + 2.0 * 2.0, 1e-11);
}

// Behind an elastic gear it is the motor's: the resonance of 0.4 and 0.5.
TEST(Armature, IsOnTheMotorsSideOfAnElasticGear) {
  const double push = 4.0, t = 0.37, k = 300.0, load = 0.5,
               w = std::sqrt(k * (1.0 / kArmature + 1.0 / load)),
               x = -push / (load * w * w) * (1.0 - std::cos(w * t));
  const std::string urdf = robot(
      "<link name='load'><inertial><mass value='1'/><inertia ixx='0.5' ixy='0' ixz='0' iyy='0.5' "
      "iyz='0' izz='0.5'/></inertial></link><joint name='axis' type='continuous'><parent "
      "link='ground'/><child link='load'/><axis xyz='0 0 1'/><codesign:actuator armature='0.4' "
      "stiffness='300'/></joint>");
  const std::vector<double> y =
      end_of(urdf,
             "duration: 1.0\ngravity: [0, 0, 0]\nloads: [{joint: axis, effort: 4.0}]\nsolver: "
             "{method: rodas5p, relative_tolerance: 1e-11, absolute_tolerance: 1e-13}\n",
             t, {"axis/gear_deflection"});
  EXPECT_NEAR(y[0], x, 1e-9);
}

}  // namespace
}  // namespace codesign
