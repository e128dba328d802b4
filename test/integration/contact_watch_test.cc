// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "integration/contact_watch.h"

#include <gtest/gtest.h>

#include "integration/touching.h"
#include "mechanism_codesign/simulation.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

Warnings of_fall(double speed) {
  const Problem problem =
      load_problem({"ball.urdf", free_ball("", touching_ground("shape='plane'", ""))}, {},
                   {"ball.yaml",
                    "duration: 0.2\ninitial_state: {free: {translation: [0, 0, 0.055], "
                    "linear_velocity: [0, 0, " +
                        std::to_string(-speed) + "]}}\n"},
                   {}, TrajectoryLoader(), FileLoader());
  Simulation simulation(problem, problem.parameters());
  EXPECT_TRUE(simulation.start().ok());
  EXPECT_TRUE(simulation.warnings().empty());
  EXPECT_TRUE(simulation.advance_to(0.2).ok());
  return simulation.warnings();
}

// Without loss and gravity 2/5 k delta^(5/2) = m v^2/2: 2.5 mm, a twentieth of the radius, at 0.5
// m/s.
TEST(ContactWatch, FindsTheDeepestPenetrationBetweenTheSamples) {
  const double depth = std::pow(1.25e-6 * (25.0 + 2.0 * 9.81 * 0.005), 0.4);
  EXPECT_TRUE(of_fall(0.01).empty());
  const Warnings warnings = of_fall(5.0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].code, "deep_penetration");
  EXPECT_NE(warnings[0].message.find("<codesign:contact name=\"touch\">"), std::string::npos);
  EXPECT_GT(depth, 0.0025);
  const std::size_t at = warnings[0].message.find("value: 0.0");
  ASSERT_NE(at, std::string::npos) << warnings[0].message;
  EXPECT_NEAR(std::stod(warnings[0].message.substr(at + 7)), depth, 0.05 * depth)
      << "at the end of a step near it";
}

}  // namespace
}  // namespace codesign
