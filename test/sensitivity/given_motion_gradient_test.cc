// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of studies with given motions, loads that vary and expressions of signals.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_cases.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

const char* const kParameters =
    "parameters: {mass: {}, A: {initial: 0.5}, speed: {initial: 2.0}, k: {initial: 3.0}}\n";

std::string with_mass(std::string urdf) {
  const std::string plain = "<mass value='1'/>";
  urdf.replace(urdf.find(plain), plain.size(), "<mass value='1' codesign:value='${mass}'/>");
  urdf.insert(urdf.find("<link name='ground'/>"),
              "<codesign:parameter name='mass' value='1' lower='0.5' upper='2'/>");
  return urdf;
}

/// The shoulder moves by an expression, the elbow is free and loaded by functions of time and of
/// its motion; the objective is an expression.
std::string arm_study() {
  return std::string("duration: 0.3\ninitial_state: {elbow: {position: 0.3}}\n") + kParameters +
         "motion: {shoulder: {position: \"${A*sin(speed*t) + 0.1*t^3}\"}}\n"
         "loads:\n"
         "  - {joint: elbow, effort: {type: sine, amplitude: \"${A}\", frequency: 1.3}}\n"
         "  - {joint: elbow, effort: \"${-k*elbow/position*abs(elbow/velocity) + 0.2*t}\"}\n"
         "  - {link: lower, force: [\"${-A*lower/velocity/x^3}\", 0, \"${exp(-k*t)}\"], "
         "torque: [0, \"${0.1*lower/position/z}\", 0], point: [0, 0, -0.5], frame: link}\n"
         "  - {joint: elbow, effort: {type: table, signal: elbow/position, at: [0.1, 0.25, 0.4], "
         "values: [0, \"${A*k}\", -0.2]}}\n"
         "objective:\n"
         "  integral: [{signal: \"${shoulder/effort*shoulder/velocity/k}\"}, {signal: "
         "\"${max(elbow/position, 0.1)^1.5}\", reference: \"${A*t}\"}]\n"
         "  terminal: [{signal: elbow/velocity, reference: 1.0}, {signal: "
         "\"${shoulder/acceleration - t*mass}\"}]\n";
}

/// A parallelogram whose crank has a given velocity that starts where a parameter says.
std::string ring_study() {
  return std::string(
             "duration: 0.3\ninitial_state: {left_hinge: {position: \"${A}\"}, "
             "right_hinge: {guess: 0.5}}\n") +
         kParameters +
         "motion: {left_hinge: {velocity: {type: waypoints, times: [0, 0.1, 0.3], positions: [0, "
         "\"${speed}\", \"${-k}\"], interpolation: cubic}}}\n"
         "objective: {integral: [{signal: left_hinge/effort}, {signal: left_hinge/friction, "
         "weight: 0.1}], terminal: [{signal: coupler/position/x}]}\n";
}

GradientCheck checked(const std::string& urdf, const std::string& study,
                      const std::string& coordinates, const std::string& method,
                      const std::string& gradient) {
  GradientCase c = from_texts("given", urdf, study);
  c.study.solver.coordinates =
      coordinates == "joint" ? CoordinatesKind::kJoint : CoordinatesKind::kAbsolute;
  c.study.solver.relative_tolerance = 1e-7;
  c.study.solver.absolute_tolerance = 1e-8;
  c.study.solver.maximum_step = 0.02;  // in place of a 500th of the duration
  const auto system = c.compile(method, gradient);
  const Eigen::VectorXd rho = (Eigen::VectorXd(4) << 1.1, 0.5, 2.0, 3.0).finished();
  GradientCheck check = check_gradient(system, rho, CheckMethod::kComplexStep);
  EXPECT_TRUE(check.status.ok()) << check.status.cause;
  return check;
}

class GivenMotionGradient : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {
};

TEST_P(GivenMotionGradient, IsExact) {
  const auto [method, gradient] = GetParam();
  for (const bool ring : {false, true}) {
    const std::string urdf = with_mass(ring ? four_bar(pin_friction()) : double_pendulum()),
                      study = ring ? ring_study() : arm_study();
    const GradientCheck joint = checked(urdf, study, "joint", method, gradient),
                        absolute = checked(urdf, study, "absolute", method, gradient);
    EXPECT_LT(joint.largest_relative_difference, 1e-8) << study;
    EXPECT_LT(absolute.largest_relative_difference, 1e-8) << study;
    EXPECT_NEAR(joint.evaluation.objective, absolute.evaluation.objective,
                1e-4 * std::abs(absolute.evaluation.objective));
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(joint.evaluation.gradient[k], absolute.evaluation.gradient[k],
                  1e-3 * absolute.evaluation.gradient.norm())
          << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, GivenMotionGradient,
                         ::testing::Combine(::testing::Values("rodas5p", "dopri5"),
                                            ::testing::Values("direct", "adjoint")));

// Differences of runs are as exact as the runs.
TEST(GivenMotionGradients, AgreeWithDifferencesOfIndependentRuns) {
  for (const bool ring : {false, true}) {
    GradientCase c = ring ? from_texts("given", with_mass(four_bar(pin_friction())), ring_study())
                          : from_texts("given", with_mass(double_pendulum()), arm_study());
    c.study.solver.relative_tolerance = 1e-13;
    c.study.solver.absolute_tolerance = 1e-14;
    const Eigen::VectorXd rho = (Eigen::VectorXd(4) << 1.1, 0.5, 2.0, 3.0).finished();
    const GradientCheck check =
        check_gradient(c.compile("rodas5p", "direct"), rho, CheckMethod::kRidders);
    ASSERT_TRUE(check.status.ok()) << check.status.cause;
    EXPECT_LT(check.largest_relative_difference, 1e-8) << ring;
  }
}

// A block of 1 kg whose velocity has a kink at a tuned time a = 1: its acceleration jumps there.
TEST(GivenMotionGradients, AVelocityMayHaveAKinkAtATunedTime) {
  struct Kink {
    const char *velocity, *objective;
    double value, slope;
  };
  for (const Kink& kink :
       {Kink{"min(t, a)", "integral: [{signal: j/effort}]", 1.0, 1.0},
        Kink{"t < a ? t : a", "integral: [{signal: j/effort}]", 1.0, 1.0},
        Kink{"max(0, t - a)", "integral: [{signal: \"${j/effort^2}\"}]", 1.0, -1.0},
        Kink{"max(0, t - a)", "integral: [{signal: j/effort, loss: absolute}]", 1.0, -1.0},
        Kink{"min(t, a)", "terminal: [{signal: j/position, loss: absolute}]", 1.5, 1.0}})
    for (const char* solver : {"", "method: rodas4", "method: rodas5p", "gradient: adjoint"}) {
      SCOPED_TRACE(std::string(kink.velocity) + "; " + kink.objective + "; " + solver);
      const GradientCase of = from_texts(
          "kink",
          robot(bar("a") + "<joint name='j' type='prismatic'><parent link='ground'/><child "
                           "link='a'/><axis xyz='1 0 0'/><limit effort='0' velocity='0'/></joint>"),
          std::string("duration: 2.0\nmotion: {j: {velocity: \"${") + kink.velocity +
              "}\"}}\nparameters: {a: {initial: 1.0, lower: 0.1, upper: 1.9}}\nobjective: {" +
              kink.objective + "}\nsolver: {" + solver + "}\n");
      const auto system = make_system(of.robot, of.study);
      const Evaluation run =
          evaluator_of(system).evaluate_design(system->parameters(), true, nullptr);
      ASSERT_TRUE(run.status.ok()) << describe(run.status);
      EXPECT_NEAR(run.objective, kink.value, 1e-6);
      EXPECT_NEAR(run.gradient[0], kink.slope, 1e-6);
    }
}

}  // namespace
}  // namespace codesign
