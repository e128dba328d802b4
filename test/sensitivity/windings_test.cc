// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients by the numbers of motors that a voltage moves.
#include <gtest/gtest.h>

#include "integration/mechanisms.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// @param more attributes of the actuator. @param inductive whether there is an inductance.
std::string wound_urdf(const std::string& more, bool inductive) {
  return robot(
      std::string("<codesign:parameter name='R' value='0.5'/><codesign:parameter name='L' "
                  "value='0.01'/><codesign:parameter name='K' value='0.04'/><codesign:parameter "
                  "name='bus' value='14'/><codesign:parameter name='n' value='50'/>") +
      bar("arm") +
      hinge("axis", "ground", "arm", "0 0 0",
            std::string("<codesign:actuator gear_ratio='50' codesign:gear_ratio='${n}' "
                        "rotor_inertia='2e-5' resistance='0.5' codesign:resistance='${R}' "
                        "torque_constant='0.04' codesign:torque_constant='${K}' bus_voltage='14' "
                        "codesign:bus_voltage='${bus}' ") +
                (inductive ? "inductance='0.01' codesign:inductance='${L}' " : "") + more + "/>"));
}

GradientCheck check_wound(const std::string& model, bool inductive, const std::string& solver,
                          CheckMethod method) {
  const std::string start = inductive ? ", current: \"${first}\"" : "";
  const Problem problem = load_problem(
      {"test.urdf", model}, {},
      {"test.yaml",
       "duration: 0.4\ninitial_state: {axis: {position: 0.2" + start +
           "}}\ncontrollers: {servo: {type: pid, input: axis/position, setpoint: 1.0, output: "
           "axis, gains: {p: 60.0, d: 4.0}}}\nparameters: {R: {}, K: {}, bus: {}, n: {}, " +
           (inductive ? "L: {}, first: {initial: 2.0}" : "") +
           "}\nobjective: {integral: [{signal: axis/position, reference: 1.0}, {signal: "
           "axis/current, weight: 1e-3}, {signal: mechanism/electrical_power, weight: 1e-5}, "
           "{signal: axis/copper_loss, weight: 1e-5}], terminal: [{signal: axis/velocity}, "
           "{signal: "
           "mechanism/magnetic_energy}]}\nsolver: {" +
           solver + "}\n"});
  return check_gradient(problem, problem.start(), method);
}

TEST(WindingGradients, AreThoseOfTheStepsTaken) {
  for (const char* gear : {"", "efficiency='0.8'", "stiffness='400' damping='2'"})
    for (const bool inductive : {true, false})
      for (const char* solver :
           {"coordinates: joint", "coordinates: absolute, gradient: adjoint"}) {
        const GradientCheck exact =
            check_wound(wound_urdf(gear, inductive), inductive, solver, CheckMethod::kComplexStep);
        ASSERT_TRUE(exact.status.ok()) << gear << solver << exact.status.cause;
        EXPECT_LT(exact.largest_relative_difference, 1e-8) << gear << inductive << solver;
        EXPECT_GT(exact.evaluation.gradient.cwiseAbs().minCoeff(), 1e-9) << "every number counts";
      }
}

TEST(WindingGradients, AreThoseOfIndependentRuns) {
  for (const bool inductive : {true, false}) {
    const GradientCheck independent = check_wound(
        wound_urdf("efficiency='0.8'", inductive), inductive,
        "relative_tolerance: 1.0e-13, absolute_tolerance: 1.0e-14", CheckMethod::kRidders);
    ASSERT_TRUE(independent.status.ok()) << independent.status.cause;
    EXPECT_LT(independent.largest_relative_difference, 1e-7) << inductive;
  }
}

TEST(WindingGradients, BothIntegratorsAgree) {
  const auto gradient = [](const char* integrator) {
    return check_wound(
               wound_urdf("", true), true,
               std::string("integrator: ") + integrator +
                   ", coordinates: absolute, relative_tolerance: 1.0e-9, absolute_tolerance: "
                   "1.0e-10",
               CheckMethod::kComplexStep)
        .evaluation.gradient;
  };
  const Eigen::VectorXd one = gradient("rosenbrock"), other = gradient("idas");
  ASSERT_EQ(one.size(), other.size());
  for (Eigen::Index k = 0; k < one.size(); ++k)
    EXPECT_NEAR(one[k], other[k], 1e-5 * (1e-3 + std::abs(one[k]))) << k;
}

}  // namespace
}  // namespace codesign
