// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients through couplings, stops and saturated actuators, whose numbers are design parameters.
#include <gtest/gtest.h>

#include "integration/servo.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

/// A motor turns a bar through a gear and pulls a rack; the gear's ratio, the rack's radius and
/// offset and the motor's rating are parameters.
std::string drive() {
  return robot(
      "<codesign:parameter name='ratio' value='6'/><codesign:parameter name='radius' value='0.05'/>"
      "<codesign:parameter name='start' value='0.02'/><codesign:parameter name='rating' "
      "value='1.5'/>"
      "<link name='rotor'><inertial><mass value='0.2'/><inertia ixx='0.001' ixy='0' ixz='0' "
      "iyy='0.001' iyz='0' izz='0.001'/>"
      "</inertial></link><link name='rack'><inertial><mass value='0.5'/><inertia ixx='0.001' "
      "ixy='0' ixz='0' iyy='0.001' iyz='0' "
      "izz='0.001'/></inertial></link>" +
      bar("bar") +
      "<joint name='motor' type='revolute'><parent link='ground'/><child link='rotor'/><origin "
      "xyz='0 0.2 0'/><axis xyz='0 1 0'/>"
      "<limit lower='-40' upper='40' effort='1.5' codesign:effort='${rating}' "
      "velocity='50'/></joint>" +
      hinge("hinge", "ground", "bar", "0 0 0") +
      "<joint name='slide' type='prismatic'><parent link='ground'/><child link='rack'/><origin "
      "xyz='0 0.5 0'/><axis xyz='1 0 0'/>"
      "<limit lower='-1' upper='0.06' effort='1' velocity='1'/><mimic joint='hinge' "
      "multiplier='0.05' "
      "codesign:multiplier='${radius}' offset='0.02' codesign:offset='${start}'/></joint>"
      "<coupling name='gear'><predecessor link='bar'/><successor link='rotor'/><ratio value='6' "
      "codesign:value='${ratio}'/></coupling>");
}

std::string study(const std::string& limits, const std::string& solver) {
  return "duration: 0.5\ninitial_state: {hinge: {position: 0.4, velocity: -1.0}}\n"
         "controllers: {servo: {type: pid, input: hinge/position, setpoint: 1.2, output: motor, "
         "gains: {p: 3.0, d: 0.4}}}\n"
         "parameters: {ratio: {}, radius: {}, start: {}, rating: {}}\n"
         "objective: {integral: [{signal: servo/error}, {signal: motor/effort, weight: 0.1}],\n"
         "  terminal: [{signal: slide/position, weight: 100.0}, {signal: motor/velocity, weight: "
         "0.01}]}\nlimits: " +
         limits + "\nsolver: " + solver + "\n";
}

GradientCheck check(const std::string& limits, const std::string& solver, CheckMethod method) {
  const auto system = compile(drive(), study(limits, solver));
  Eigen::VectorXd rho(4);
  rho << 6.0, 0.05, 0.02, 1.5;
  return check_gradient(system, rho, method);
}

TEST(CouplingsAndLimits, TheGradientIsThatOfTheStepsTaken) {
  for (const char* limits :
       {"{}", "{effort: true}", "{effort: true, position: true, stiffness: 1e3, width: 5e-3}"}) {
    const GradientCheck c = check(limits, "{}", CheckMethod::kComplexStep);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 1e-9) << limits;
    EXPECT_GT(c.evaluation.gradient.head(3).cwiseAbs().minCoeff(), 1e-6) << limits;
    EXPECT_EQ(c.evaluation.gradient[3] == 0.0, std::string(limits) == "{}")
        << "the rating counts where it bounds";
  }
}

TEST(CouplingsAndLimits, TheGradientIsThatOfTheMotion) {
  const char* const limits = "{effort: true, position: true, stiffness: 1e3, width: 5e-3}";
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const GradientCheck c = check(limits,
                                  std::string("{integrator: ") + integrator +
                                      ", relative_tolerance: 1e-8, absolute_tolerance: 1e-9}",
                                  CheckMethod::kRidders);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 1e-4) << integrator;
  }
}

}  // namespace
}  // namespace codesign
