// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// The gear ratio with which a motor of given torque accelerates an inertia most is sqrt(J/J_r), and
// sqrt(J/(eta J_r)) of a gear that loses: at n the acceleration is eta n T/(J + eta n^2 J_r).
#include <gtest/gtest.h>
#include <cmath>

#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

constexpr double kTableInertia = 0.5, kTableRotor = 2e-4;

std::string turntable(const std::string& losses) {
  return "<robot name='turntable' xmlns:codesign='urn:mechanism_codesign'><codesign:parameter "
         "name='ratio' value='20' lower='5' upper='200'/><link name='base'/><link "
         "name='table'><inertial><mass value='10'/><inertia ixx='0.3' ixy='0' ixz='0' iyy='0.3' "
         "iyz='0' izz='0.5'/></inertial></link><joint name='turn' type='continuous'><parent "
         "link='base'/><child link='table'/><axis xyz='0 0 1'/><codesign:actuator gear_ratio='20' "
         "codesign:gear_ratio='${ratio}' rotor_inertia='2e-4' " +
         losses + "/></joint></robot>";
}

/// The motor has 0.1 N m; the table should turn as far as possible in a second.
const char* const kTurntableStudy =
    "duration: 1.0\ninitial_state: {turn: {velocity: 0.2}}\ncontrollers: {motor: {type: "
    "state_feedback, output: turn, feedforward: \"${0.1*ratio}\"}}\nparameters: {ratio: {}}\n"
    "objective: {terminal: [{signal: turn/velocity, reference: 20.0}]}\n"
    "optimizer: {relative_tolerance: 1.0e-10}\n";

double best_ratio(const std::string& losses) {
  const Problem problem =
      load_problem({"turntable.urdf", turntable(losses)}, {}, {"study.yaml", kTurntableStudy});
  const OptimizationResult result = optimize(problem);
  EXPECT_TRUE(result.status.ok()) << result.status.cause;
  return result.best.rho[0];
}

TEST(GearRatio, OfTheGreatestAcceleration) {
  EXPECT_NEAR(best_ratio(""), std::sqrt(kTableInertia / kTableRotor), 1e-3);
}

TEST(GearRatio, OfAGearThatLoses) {
  EXPECT_NEAR(best_ratio("efficiency='0.7' transition_velocity='0.001' smoothing='1e-6'"),
              std::sqrt(kTableInertia / (0.7 * kTableRotor)), 1e-2);
}

}  // namespace
}  // namespace codesign
