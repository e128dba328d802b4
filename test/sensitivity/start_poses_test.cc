// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients by parameters that set the poses and velocities which planar and floating joints start
// with, free and within loops.
#include <gtest/gtest.h>

#include "integration/servo.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

struct StartCase {
  std::string name, joint, start, loop;
};

void PrintTo(const StartCase& c, std::ostream* out) { *out << c.name; }

std::vector<StartCase> cases() {
  const std::string floating =
      "<joint name='base' type='floating'><parent link='ground'/><child link='box'/><origin "
      "xyz='0.1 0.2 0.3' rpy='0.2 0.4 -0.3'/></joint>";
  const std::string planar =
      "<joint name='base' type='planar'><parent link='ground'/><child link='box'/><origin rpy='0 "
      "0.6 0' codesign:rpy='0 ${0.3*w} "
      "0'/><axis xyz='0 0 1'/></joint>";
  const std::string turned =
      "rotation: ['${a}', '${2*b}', '${a + w/3}'], angular_velocity: ['${w*a}', '${b}', '${3*a}']";
  const auto loop = [](const std::string& type, const std::string& more = "") {
    return "<loop name='tie' type='codesign:" + type +
           "'><predecessor link='ground'><origin xyz='0.3 0.1 0.2'/></predecessor>" +
           "<successor link='arm'><origin xyz='0.1 0.3 -0.2' codesign:xyz='${0.25*a} 0.3 "
           "-0.2'/></successor><axis xyz='1 0 0'/>" +
           more + "</loop>";
  };
  const std::string driven = "drive: {position: '${b}', velocity: '${w}'}";
  return {
      {"floating", floating,
       "base: {translation: [0.1, '${a*b}', '${sin(w)}'], linear_velocity: ['${w}', '${a*a}', "
       "0.2], " +
           turned + "}, " + driven,
       ""},
      {"planar", planar,
       "base: {translation: ['${a*b}', '${a - b}', 0], rotation: '${3*a}', linear_velocity: "
       "['${3*b}', '${w}', 0], "
       "angular_velocity: '${a*4}'}, " +
           driven,
       ""},
      {"floating_on_a_ball", floating, "base: {" + turned + "}, " + driven, loop("spherical")},
      {"floating_on_a_rod", floating,
       "base: {translation: [0.1, '${a*b}', '${0.2*w}'], linear_velocity: ['${w}', '${a*a}', 0.2]}",
       loop("distance", "<codesign:length value='0.54' codesign:value='${0.5 + 0.1*a}'/>")},
      {"planar_on_a_rod", planar,
       "base: {rotation: '${3*a}', angular_velocity: '${a*4}'}, " + driven,
       loop("distance", "<codesign:length value='0.54' codesign:value='${0.5 + 0.1*a}'/>")}};
}

std::string model(const StartCase& c) {
  return robot(
      "<codesign:parameter name='a' value='0.4'/><codesign:parameter name='b' "
      "value='-0.3'/><codesign:parameter name='w' value='2'/>"
      "<link name='box'><inertial><origin xyz='0.1 0.02 -0.05' rpy='0.1 0.2 0.3'/><mass "
      "value='2'/><inertia ixx='0.1' ixy='0' ixz='0' "
      "iyy='0.2' iyz='0' izz='0.25'/></inertial></link><link name='arm'><inertial><origin xyz='0 "
      "0.3 -0.2'/><mass value='1'/><inertia "
      "ixx='0.05' ixy='0' ixz='0' iyy='0.02' iyz='0' izz='0.04'/></inertial></link>" +
      c.joint +
      "<joint name='drive' type='continuous'><parent link='box'/><child link='arm'/><origin "
      "xyz='0.2 0.1 0.3'/><axis xyz='0.3 1 "
      "-0.4'/></joint>" +
      c.loop);
}

GradientCheck check(const StartCase& c, const std::string& solver, CheckMethod method) {
  const auto system =
      compile(model(c),
              "duration: 0.3\ninitial_state: {" + c.start +
                  "}\nparameters: {a: {}, b: {}, w: {}}\n"
                  "objective:\n  integral: [{signal: box/position/x + box/orientation/y}, {signal: "
                  "arm/velocity/z}, {signal: arm/angular_velocity/x}]\n"
                  "  terminal: [{signal: arm/position/y, reference: 0.2}, {signal: "
                  "drive/acceleration, weight: "
                  "0.01}, {signal: box/orientation/w, weight: 3.0}]\n"
                  "solver: {relative_tolerance: 1e-8, absolute_tolerance: 1e-9" +
                  solver + "}\n");
  Eigen::VectorXd rho(3);
  rho << 0.4, -0.3, 2.0;
  return check_gradient(system, rho, method);
}

class StartPoses : public ::testing::TestWithParam<StartCase> {};

TEST_P(StartPoses, TheGradientIsThatOfTheStepsTaken) {
  for (const char* solver : {", gradient: direct", ", gradient: adjoint"}) {
    const GradientCheck c = check(GetParam(), solver, CheckMethod::kComplexStep);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 1e-9) << solver;
    EXPECT_GT(c.evaluation.gradient.cwiseAbs().minCoeff(), 1e-4) << solver;
  }
}

TEST_P(StartPoses, TheGradientIsThatOfTheMotion) {
  for (const char* solver : {", integrator: rosenbrock", ", integrator: idas"}) {
    const GradientCheck c = check(GetParam(), solver, CheckMethod::kRidders);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 2e-5) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(AllStarts, StartPoses, ::testing::ValuesIn(cases()),
                         [](const auto& c) { return c.param.name; });

}  // namespace
}  // namespace codesign
