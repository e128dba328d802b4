// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Couplings in motion.
#include <gtest/gtest.h>

#include <algorithm>

#include "assembly/count_equations.h"
#include "integration/servo.h"
#include "integration/simulation_of.h"
#include "mechanism_codesign/simulation.h"

namespace codesign {
namespace {

/// A flywheel on a spring, whose rotor turns 20 times as far the other way and pushes a rack; a
/// pointer without mass shows the rotor's turn.
std::string geared() {
  const auto wheel = [](const std::string& name, const std::string& izz) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='" +
           izz + "'/></inertial></link>";
  };
  const auto turn = [](const std::string& name, const std::string& child, const std::string& more) {
    return "<joint name='" + name + "' type='continuous'><parent link='ground'/><child link='" +
           child + "'/><axis xyz='0 0 1'/>" + more + "</joint>";
  };
  return robot(wheel("load", "0.8") + wheel("rotor", "0.001") + wheel("rack", "1") +
               "<link name='pointer'/>" +
               turn("out", "load", "<codesign:torsion_spring stiffness='3' free_position='0.5'/>") +
               turn("motor", "rotor", "<mimic joint='out' multiplier='-20' offset='0.4'/>") +
               turn("dial", "pointer", "<mimic joint='motor' multiplier='0.1' offset='-1'/>") +
               "<joint name='slide' type='prismatic'><parent link='ground'/><child "
               "link='rack'/><axis xyz='1 0 0'/><limit effort='1' "
               "velocity='1'/></joint><coupling name='pinion'><predecessor link='load'/><successor "
               "link='rack'/><ratio "
               "value='0.1'/></coupling>");
}

TEST(Couplings, StayInStepOverManyTurnsAndMoveAsOneInertia) {
  const double inertia = 0.8 + 400.0 * 0.001 + 0.01, omega = std::sqrt(3.0 / inertia);
  for (const char* integrator : {"rosenbrock", "idas"}) {
    // Projection keeps the constraint to rounding, stabilization to the tolerance of positions of
    // several hundred radians.
    const double in_step = integrator == std::string("idas") ? 2e-3 : 1e-6;
    const std::string solver = std::string("{integrator: ") + integrator +
                               ", relative_tolerance: 1e-8, absolute_tolerance: 1e-9}";
    Simulation simulation = simulation_of(
        compile(geared(), motion_study(3.0, "{out: {position: 9.0}}", "out/velocity", solver)), {});
    const std::vector<std::string>& names = simulation.names().joints;
    const auto joint = [&names](const Frame& frame, const std::string& name) {
      return frame.joints[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                                   names.begin())];
    };
    const Status status = simulate(&simulation, 3.0, 31, [&](const Frame& frame) {
      const double theta = 0.5 + 8.5 * std::cos(omega * frame.time),
                   rate = -8.5 * omega * std::sin(omega * frame.time);
      EXPECT_NEAR(joint(frame, "out").position, theta, 0.1 * in_step + 2e-5)
          << integrator << frame.time;
      EXPECT_NEAR(joint(frame, "motor").position, -20.0 * joint(frame, "out").position + 0.4,
                  in_step)
          << integrator << frame.time;
      EXPECT_NEAR(joint(frame, "slide").position, 0.1 * joint(frame, "out").position, in_step)
          << integrator << frame.time;
      EXPECT_NEAR(joint(frame, "dial").position, 0.1 * joint(frame, "motor").position - 1.0, 1e-12);
      EXPECT_NEAR(joint(frame, "dial").velocity, -2.0 * rate, 1e-3);
      return true;
    });
    EXPECT_TRUE(status.ok()) << status.cause;
  }
}

TEST(Couplings, AreCountedAndTakeTheirFreedoms) {
  Status status;
  const Counts counts = count_equations(
      *compile(geared(), motion_study(1.0, "{}", "out/velocity", "{}")), {}, &status);
  ASSERT_TRUE(status.ok()) << status.cause;
  EXPECT_EQ(counts.constraints, 5 + 5 + 5 + 2 + 3);
  EXPECT_EQ(counts.degrees_of_freedom, 1);
}

TEST(Couplings, StartValuesThatContradictThemAreBadInputWithTheirPlace) {
  try {
    compile(geared(), motion_study(1.0, "{out: {position: 1.0}, slide: {position: 1.0}}",
                                   "out/velocity", "{}"));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("<coupling name=\"pinion\">: the start values contradict it"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace codesign
