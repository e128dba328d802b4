// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of runs that begin with a stuck joint, whose deflection depends on the design.
#include <gtest/gtest.h>

#include "integration/mechanisms.h"
#include "mechanism_codesign/gradient.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct StuckCase {
  std::string name, urdf, initial, more, parameters, signals;
};

std::string declared_number(const std::string& name, const std::string& value) {
  return "<codesign:parameter name='" + name + "' value='" + value + "'/>";
}

/// Friction whose numbers are parameters. @param law with the static coefficient's attribute.
std::string bristle_friction(const std::string& law) {
  return "<codesign:friction model='" + law +
         "' transition_velocity='0.05' bristle_stiffness='40' "
         "codesign:bristle_stiffness='${sigma}' "
         "bristle_damping='30' mu_static='0.5' codesign:mu_static='${mu}' mu_dynamic='0.3' "
         "pin_radius='0.3' joint_length='0.4'/>";
}

std::string stuck_numbers() {
  return declared_number("sigma", "40") + declared_number("mu", "0.5") +
         declared_number("mass", "1");
}

std::string weighted(std::string urdf) {
  const std::string plain = "<mass value='1'/>";
  urdf.replace(urdf.find(plain), plain.size(), "<mass value='1' codesign:value='${mass}'/>");
  return urdf.insert(urdf.find("<link name='ground'/>"), stuck_numbers());
}

/// Two hinges, one above the other, that hold, or of which the upper one slides. The bristles are
/// damped so much that no velocity changes its sign, where LuGre's law has a corner. The static
/// coefficient of Gonthier's counts only where a contact slides.
StuckCase stuck_chain(const std::string& law, const std::string& start, const std::string& elbow) {
  return {law + (start == "0.4" ? "_slides" : "_holds"),
          weighted(double_pendulum(bristle_friction(law))),
          "{shoulder: {position: " + start + ", stuck: true}, elbow: {position: " + elbow +
              ", stuck: true}}",
          "loads: [{joint: shoulder, effort: \"${4*t}\"}]\n",
          law == "gonthier" ? "sigma: {}, mass: {}" : "sigma: {}, mu: {}, mass: {}",
          "{signal: shoulder/position}, {signal: elbow/velocity}, {signal: shoulder/friction}"};
}

/// A parallelogram that one of its hinges holds.
StuckCase stuck_loop() {
  std::string urdf = weighted(four_bar(bristle_friction("lugre")));
  const std::string loop = "<loop name='right_pin'";
  urdf.insert(urdf.find(loop) + loop.size(), " codesign:out_of_plane='zero'");
  return {"loop",
          urdf,
          "{left_hinge: {position: 0.05, stuck: true}, right_hinge: {guess: 0.05}}",
          "loads: [{joint: left_hinge, effort: \"${3*t}\"}]\n",
          "sigma: {}, mu: {}, mass: {}",
          "{signal: left_hinge/position}, {signal: left_hinge/friction}"};
}

/// A puck that a plane holds, or cannot hold, in a direction of its own.
StuckCase stuck_plane(const std::string& name, const std::string& load) {
  return {
      "plane_" + name,
      robot(stuck_numbers() +
            "<link name='box'><inertial><mass value='1' codesign:value='${mass}'/><inertia "
            "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.02'/></inertial></link><joint "
            "name='plane' type='planar'><parent link='ground'/><child link='box'/><axis xyz='0 "
            "0 1'/>" +
            bristle_friction("lugre") + "</joint>"),
      "{plane: {stuck: true}}",
      "gravity: [1.0, -0.5, -5.0]\nloads: [{link: box, force: [" + load +
          ", 0.0], point: [0.1, 0.02, 0.0]}]\n",
      "sigma: {}, mu: {}, mass: {}",
      "{signal: box/position/x}, {signal: box/velocity/y}, {signal: plane/friction}"};
}

StuckCase stuck_gear() {
  return {"gear",
          robot(stuck_numbers() + declared_number("coulomb", "0.02") + bar("bar") +
                hinge("hinge", "ground", "bar", "0 0 0",
                      "<codesign:actuator gear_ratio='40' rotor_inertia='1e-3' coulomb='0.02' "
                      "codesign:coulomb='${coulomb}' bristle_stiffness='40' "
                      "codesign:bristle_stiffness='${sigma}' efficiency='0.8' model='lugre'/>")),
          "{hinge: {position: 0.1, stuck: true}}",
          "loads: [{joint: hinge, effort: \"${4*t}\"}]\n",
          "sigma: {}, coulomb: {}",
          "{signal: hinge/position}, {signal: hinge/gear_loss}"};
}

class StuckGradients : public ::testing::TestWithParam<StuckCase> {};

GradientCheck stuck_check(const StuckCase& c, const std::string& solver, CheckMethod method) {
  const std::string study = "duration: 0.3\ninitial_state: " + c.initial + "\nparameters: {" +
                            c.parameters + "}\nobjective: {integral: [" + c.signals + "]}\n" +
                            c.more + "solver: {" + solver + "}\n";
  const Problem problem = load_problem({"test.urdf", c.urdf}, {}, {"test.yaml", study});
  return check_gradient(problem, problem.start(), method);
}

TEST_P(StuckGradients, AreThoseOfTheStepsTakenAndOfIndependentRuns) {
  for (const char* solver : {"coordinates: joint", "coordinates: absolute, gradient: adjoint"}) {
    const GradientCheck exact = stuck_check(GetParam(), solver, CheckMethod::kComplexStep);
    ASSERT_TRUE(exact.status.ok()) << solver << exact.status.cause;
    EXPECT_LT(exact.largest_relative_difference, 1e-9) << solver;
    EXPECT_GT(exact.evaluation.gradient.cwiseAbs().minCoeff(), 1e-9) << "every number counts";
    const GradientCheck apart = stuck_check(
        GetParam(), std::string(solver) + ", relative_tolerance: 1e-13, absolute_tolerance: 1e-14",
        CheckMethod::kRidders);
    ASSERT_TRUE(apart.status.ok()) << solver << apart.status.cause;
    EXPECT_LT(apart.largest_relative_difference, 1e-8) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, StuckGradients,
                         ::testing::Values(stuck_chain("lugre", "0.02", "-0.1"),
                                           stuck_chain("gonthier", "0.02", "-0.1"),
                                           stuck_chain("lugre", "0.4", "-0.35"), stuck_loop(),
                                           stuck_plane("pulled_off", "\"${0.3 + 8*t}\", 0.2"),
                                           stuck_plane("slides", "3.0, 0.2"), stuck_gear()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace codesign
