// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Runs that begin with a contact which slides, whose bristles depend on the design; theory (13j).
#include <gtest/gtest.h>

#include "integration/mechanisms.h"
#include "mechanism_codesign/gradient.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

struct SlidingCase {
  std::string name, urdf, initial, parameters, signals;
};

std::string number_named(const std::string& name, const std::string& value) {
  return "<codesign:parameter name='" + name + "' value='" + value + "'/>";
}

std::string sliding_numbers() {
  return number_named("mu", "0.5") + number_named("vs", "0.1") + number_named("mass", "1");
}

std::string sliding_friction(const std::string& law) {
  return "<codesign:friction model='" + law +
         "' transition_velocity='0.1' codesign:transition_velocity='${vs}' bristle_stiffness='40' "
         "bristle_damping='0.5' mu_static='0.5' codesign:mu_static='${mu}' mu_dynamic='0.3' "
         "pin_radius='0.3' joint_length='0.4' joint_width='0.3'/>";
}

std::string sliding_box(const std::string& type, const std::string& axis, const std::string& law) {
  const bool is_bounded = type == "prismatic";
  return robot(sliding_numbers() +
               "<link name='box'><inertial><mass value='1' codesign:value='${mass}'/><inertia "
               "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.02'/></inertial></link><joint "
               "name='joint' type='" +
               type + "'><parent link='ground'/><child link='box'/><axis xyz='" + axis + "'/>" +
               (is_bounded ? "<limit effort='0' velocity='0'/>" : "") + sliding_friction(law) +
               "</joint>");
}

SlidingCase slide(const std::string& law, const std::string& speed) {
  return {law + "_slide", sliding_box("prismatic", "1 0 0", law),
          "{joint: {velocity: \"${" + speed + "*v0}\"}}",
          "mu: {}, vs: {}, v0: {initial: 1.0, lower: 0.5, upper: 2.0}",
          "{signal: joint/position}, {signal: joint/friction, weight: 0.01}"};
}

SlidingCase puck_in_plane(const std::string& law) {
  return {law + "_plane", sliding_box("planar", "0 0 1", law),
          "{joint: {linear_velocity: [\"${0.1*v0}\", 0.05, 0.0], angular_velocity: 0.3}}",
          (law == "lugre" ? "mu: {}, " : "") +
              std::string("vs: {}, v0: {initial: 1.0, lower: 0.5, upper: 2.0}"),
          "{signal: box/position/x}, {signal: box/velocity/y}"};
}

SlidingCase lossy_gear(const std::string& law) {
  return {law + "_gear",
          robot(sliding_numbers() + bar("bar") +
                hinge("joint", "ground", "bar", "0 0 0",
                      "<codesign:actuator gear_ratio='40' rotor_inertia='1e-3' coulomb='0.02' "
                      "bristle_stiffness='40' efficiency='0.8' model='" +
                          law + "' " +
                          (law == "gonthier" ? "transition_velocity='0.1' "
                                               "codesign:transition_velocity='${vs}'"
                                             : "") +
                          "/>")),
          "{joint: {position: 0.3, velocity: \"${0.2*v0}\"}}",
          "v0: {initial: 1.0, lower: 0.5, upper: 2.0}",
          "{signal: joint/position}, {signal: joint/gear_loss, weight: 0.01}"};
}

Problem sliding_problem(const SlidingCase& c, const std::string& solver) {
  const std::string study = "duration: 0.05\ninitial_state: " + c.initial + "\nparameters: {" +
                            c.parameters + "}\nobjective: {integral: [" + c.signals +
                            "]}\nsolver: {" + solver + "}\n";
  return load_problem({"test.urdf", c.urdf}, {}, {"test.yaml", study});
}

class SteadyStart : public ::testing::TestWithParam<SlidingCase> {};

TEST_P(SteadyStart, GradientsAreThoseOfTheStepsTakenAndOfIndependentRuns) {
  for (const char* solver : {"coordinates: joint", "coordinates: absolute, gradient: adjoint"}) {
    const Problem problem = sliding_problem(GetParam(), solver);
    const GradientCheck exact = check_gradient(problem, problem.start(), CheckMethod::kComplexStep);
    ASSERT_TRUE(exact.status.ok()) << solver << exact.status.cause;
    EXPECT_LT(exact.largest_relative_difference, 1e-9) << solver;
    EXPECT_GT(exact.evaluation.gradient.cwiseAbs().minCoeff(), 1e-12) << "every number counts";
    const Problem tight = sliding_problem(
        GetParam(), std::string(solver) + ", relative_tolerance: 1e-13, absolute_tolerance: 1e-14");
    const GradientCheck apart = check_gradient(tight, tight.start(), CheckMethod::kRidders);
    ASSERT_TRUE(apart.status.ok()) << solver << apart.status.cause;
    EXPECT_LT(apart.largest_relative_difference, 1e-7) << solver;
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, SteadyStart,
                         ::testing::Values(slide("lugre", "0.2"), slide("lugre", "0.1"),
                                           slide("gonthier", "0.15"), puck_in_plane("lugre"),
                                           puck_in_plane("gonthier"), lossy_gear("lugre"),
                                           lossy_gear("gonthier")),
                         [](const auto& c) {
                           static int count = 0;
                           return c.param.name + std::to_string(count++);
                         });

TEST(SteadyStarts, AreThoseOfContactsThatHaveSlidForLong) {
  // All numbers of bristles are defaults, whose bristles would take 1e-4 s to deflect.
  for (const char* law : {"lugre", "gonthier"})
    for (const double speed : {1.0, -1.0, 3e-3}) {
      const Problem problem = load_problem(
          {"test.urdf",
           robot("<link name='box'><inertial><origin xyz='0 0 0.1'/><mass value='2'/><inertia "
                 "ixx='0.01' ixy='0' ixz='0' iyy='0.01' iyz='0' izz='0.02'/></inertial></link>"
                 "<joint name='slide' type='prismatic'><parent link='ground'/><child link='box'/>"
                 "<axis xyz='1 0 0'/><limit effort='0' velocity='0'/><codesign:friction model='" +
                 std::string(law) +
                 "' mu_static='0.4' mu_dynamic='0.3' transition_velocity='0.01' joint_length='0.1' "
                 "joint_width='0.05'/></joint>")},
          {},
          {"test.yaml",
           "duration: 0.1\ninitial_state: {slide: {velocity: " + std::to_string(speed) + "}}\n"});
      Simulation simulation(problem, problem.parameters(),
                            {"slide/friction", "slide/normal_force", "slide/velocity"});
      Frame first, last;
      const Status status = simulate(&simulation, 0.1, 2, [&](const Frame& frame) {
        if (frame.time == 0.0) first = frame;
        last = frame;
        return true;
      });
      ASSERT_TRUE(status.ok()) << law << speed << status.cause;
      const double mu = -first.signals[0] / first.signals[1] * (speed < 0.0 ? -1.0 : 1.0);
      EXPECT_GE(mu, 0.3 - 1e-9) << law << ' ' << speed;
      EXPECT_LE(mu, 0.4 + 1e-9) << law << ' ' << speed;
      if (std::abs(speed) == 1.0) {
        EXPECT_NEAR(mu, 0.3, 1e-6) << law;
        EXPECT_GT(std::abs(last.signals[2]), 0.0);
      }
    }
}

}  // namespace
}  // namespace codesign
