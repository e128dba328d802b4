// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Gradients of objectives with reactions of joints, in the integral and at the end.
#include <gtest/gtest.h>

#include "assembly/make_system.h"
#include "cases/shipped.h"
#include "equations/compiled_system.h"
#include "integration/linkages.h"
#include "integration/servo.h"
#include "mechanism_codesign/gradient.h"
#include "sensitivity/gradient_check.h"

namespace codesign {
namespace {

const char* const kIntegral =
    "integral: [{signal: crank_joint/reaction_force/x, weight: 1e-3}, {signal: "
    "slider_joint/reaction_torque/z, weight: 0.1}, {signal: "
    "ball_joint_z/reaction_force/y, weight: 1e-3}, {signal: crank_joint/reaction_torque/x, weight: "
    "0.1}]";
const char* const kTerminal =
    "terminal: [{signal: slider_pin/reaction_force/x, weight: 1e-4}, {signal: "
    "slider_pin/reaction_torque/y, weight: 0.1}]";

/// The spatial slider-crank with friction, its motor's rotor and a reaction in its loop.
std::shared_ptr<const CompiledSystem> slider_crank(const std::string& objective,
                                                   const std::string& solver) {
  const std::string root = source_dir();
  const RobotDescription robot =
      read_urdf(read_source(root + "/urdf/slider_crank.urdf"),
                {{"rotor.urdf",
                  "<robot name='slider_crank' xmlns:codesign='urn:mechanism_codesign'><joint "
                  "name='crank_joint'><codesign:actuator "
                  "gear_ratio='4' codesign:gear_ratio='${4*crank_length/0.08}' "
                  "rotor_inertia='0.01'/></joint></robot>"}});
  const std::string study =
      "duration: 0.3\ninitial_state: {crank_joint: {position: 0.0, velocity: -10.0}}\n"
      "controllers: {crank_speed: {type: pid, input: crank_joint/velocity, setpoint: -10.0, "
      "output: crank_joint, gains: {p: '${Kp}'}}}\n"
      "parameters: {crank_length: {}, rod_length: {}, slider_width: {}, Kp: {initial: 1.0}}\n"
      "objective: " +
      objective + "\nsolver: {" + solver + "}\n";
  return make_system(robot, read_study({"study.yaml", study}, robot));
}

GradientCheck check(const std::shared_ptr<const CompiledSystem>& system, CheckMethod method) {
  Eigen::VectorXd rho(static_cast<Eigen::Index>(system->study().tuned.size()));
  for (std::size_t k = 0; k < system->study().tuned.size(); ++k)
    rho[static_cast<Eigen::Index>(k)] =
        system->study().parameters[static_cast<std::size_t>(system->study().tuned[k])].value;
  return check_gradient(system, rho, method);
}

TEST(Reactions, TheGradientIsThatOfTheStepsTaken) {
  for (const char* gradient : {"gradient: direct", "gradient: adjoint"}) {
    const GradientCheck c =
        check(slider_crank("{" + std::string(kIntegral) + ", " + kTerminal + "}", gradient),
              CheckMethod::kComplexStep);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 1e-9) << gradient;
    EXPECT_GT(c.evaluation.gradient.cwiseAbs().minCoeff(), 1e-6) << gradient;
  }
}

TEST(Reactions, TheGradientIsThatOfTheMotion) {
  for (const char* integrator : {"rosenbrock", "idas"}) {
    const std::string solver =
        std::string("relative_tolerance: 1e-9, absolute_tolerance: 1e-10, integrator: ") +
        integrator;
    const GradientCheck c =
        check(slider_crank("{" + std::string(kTerminal) + "}", solver), CheckMethod::kRidders);
    ASSERT_TRUE(c.status.ok()) << c.status.cause;
    EXPECT_LT(c.largest_relative_difference, 1e-5) << integrator;
  }
}

TEST(Reactions, WhatNothingDeterminesIsTold) {
  const auto warnings_of = [](const std::string& signal) {
    const RobotDescription robot = read_urdf({"test.urdf", four_bar()});
    const std::string study =
        "duration: 0.1\ninitial_state: {left_hinge: {position: 0.4}, right_hinge: {guess: "
        "0.4}}\nobjective: {terminal: "
        "[{signal: " +
        signal + "}]}\n";
    Warnings warnings;
    make_system(robot, read_study({"study.yaml", study}, robot), &warnings);
    return warnings;
  };
  for (const char* determined :
       {"left_hinge/reaction_force/x", "right_pin/reaction_force/z", "left_pin/reaction_torque/y"})
    EXPECT_TRUE(warnings_of(determined).empty()) << determined;
  for (const char* open : {"left_hinge/reaction_force/y", "right_pin/reaction_torque/x",
                           "left_pin/reaction_torque/z"}) {
    const Warnings warnings = warnings_of(open);
    ASSERT_EQ(warnings.size(), 1U) << open;
    EXPECT_EQ(warnings[0].code, "undetermined_reaction");
    EXPECT_EQ(warnings[0].where.file, "study.yaml");
    EXPECT_NE(warnings[0].message.find(open), std::string::npos) << warnings[0].message;
  }
}

}  // namespace
}  // namespace codesign
