// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/setpoint_bounds.h"

#include <gtest/gtest.h>

#include <string>

namespace codesign::setpoint_bounds {
namespace {

/// A mass of 2 kg that a controller moves along 0.5 sin(2 pi t): the force is at most 39.48 N.
Warnings warnings_of(const std::string& bounds,
                     const std::string& setpoint = "{type: sine, amplitude: 0.5, period: 1.0}",
                     const std::string& input = "slide/position") {
  const SourceText urdf{"block.urdf", R"(<robot name="block">
  <link name="ground"/>
  <link name="block"><inertial><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>
  <joint name="slide" type="prismatic"><parent link="ground"/><child link="block"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="100" velocity="10"/></joint>
</robot>)"};
  const Problem problem = load_problem(
      urdf, {},
      {"block.yaml", "duration: 1.0\ncontrollers: {hold: {type: pid, input: " + input +
                         ", setpoint: " + setpoint +
                         ", output: slide, gains: {p: \"${Kp}\", d: 10}}}\nparameters: {Kp: "
                         "{initial: 100, lower: 1, upper: 1000}}\nobjective: {terminal: [{signal: "
                         "hold/error}]}\n" +
                         bounds});
  return find_bounds_beyond_setpoints(problem, problem.parameters());
}

TEST(SetpointBounds, AForceThatIsTooSmallIsTold) {
  const Warnings warnings = warnings_of("path: [{signal: slide/effort, between: [-30.0, 30.0]}]\n");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, "bound_beyond_setpoints");
  EXPECT_NE(warnings[0].message.find("39.48 of slide/effort at t = 0."), std::string::npos)
      << warnings[0].message;
  EXPECT_NE(warnings[0].message.find("path[0]"), std::string::npos);
}

TEST(SetpointBounds, PositionsVelocitiesAndPeaksToo) {
  EXPECT_EQ(
      warnings_of("path: [{signal: slide/position, at_most: 0.4}, {signal: slide/velocity, "
                  "at_least: -3.0}]\nconstraints: [{peak: slide/acceleration, at_most: 15}]\n")
          .size(),
      3u);
}

TEST(SetpointBounds, BoundsThatCanBeKeptAreNotDoubted) {
  EXPECT_TRUE(warnings_of("path: [{signal: slide/effort, between: [-40.0, 40.0]}]\n").empty());
  EXPECT_TRUE(warnings_of("path: [{signal: slide/effort, at_most: 30.0, before: 0.4}]\n").empty())
      << "the force is negative before";
  EXPECT_TRUE(
      warnings_of("path: [{signal: slide/effort, between: [-30.0, 30.0], before: 0.1}]\n").empty());
  EXPECT_TRUE(warnings_of("path: [{signal: slide/effort, at_most: 30.0}]\n", "0.3").empty());
}

TEST(SetpointBounds, WithoutAMotionNothingIsSaid) {
  EXPECT_TRUE(warnings_of("path: [{signal: slide/effort, at_most: 1.0}]\n", "0.3", "slide/velocity")
                  .empty());
  EXPECT_TRUE(warnings_of("path: [{signal: hold/output, at_most: 1.0}]\n").empty())
      << "there is no controller along the set-points";
}

}  // namespace
}  // namespace codesign::setpoint_bounds
