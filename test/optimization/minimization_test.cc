// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/minimization.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "mechanism_codesign/optimization.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

/// A flywheel of inertia J that a motor drives against a load by its angle.
const char* const kFlywheel = R"(<robot name="flywheel" xmlns:codesign="urn:mechanism_codesign">
  <codesign:parameter name="J" value="3" lower="0.5" upper="100" unit="kg m2"/>
  <link name="ground"/>
  <link name="wheel"><inertial><mass value="10"/>
    <inertia ixx="3" codesign:ixx="${J}" ixy="0" ixz="0" iyy="3" codesign:iyy="${J}" iyz="0" izz="3" codesign:izz="${J}"/>
  </inertial></link>
  <joint name="shaft" type="continuous"><parent link="ground"/><child link="wheel"/><axis xyz="0 0 1"/></joint>
</robot>
)";

/// One turn in 1 s that ends with the speed of its start, where the load brakes by 30 sin(angle):
/// the lightest wheel whose speed varies by `stroke` at most.
OptimizationResult even_turn(const std::string& start) {
  const std::string study =
      "duration: 1.0\n"
      "initial_state: {shaft: {velocity: \"${w0}\"}}\n"
      "loads: [{joint: shaft, effort: \"${torque - 30*sin(shaft/position)}\"}]\n"
      "parameters: {J: {initial: " +
      start +
      "\n"
      "objective: {terminal: [{signal: \"${J/10}\"}]}\n"
      "final: [{signal: shaft/position, between: [6.283185307179586, 6.283185307179586]},\n"
      "        {signal: \"${shaft/velocity - w0}\", between: [0, 0]}]\n"
      "constraints: [{stroke: shaft/velocity, at_most: 1.0}]\n";
  return optimize(load_problem({"flywheel.urdf", kFlywheel}, {}, {"study.yaml", study}));
}

// From these starts SLSQP stays where it is, outside. From the point inside that is found for it
// it does not always get to the lightest wheel, and then says so.
TEST(Minimization, TwoEqualitiesAreReached) {
  const auto start = [](const char* J, const char* w0, const char* torque) {
    return std::string(J) + "}, w0: {lower: 2, upper: 12, initial: " + w0 +
           "}, torque: {lower: -50, upper: 50, initial: " + torque + "}}";
  };
  for (const std::string& from :
       {start("3", "4", "5"), start("3", "5", "3"), start("3", "5", "40"), start("3", "6", "0"),
        start("3", "9", "40"), start("80", "6", "3")}) {
    const OptimizationResult result = even_turn(from);
    ASSERT_TRUE(result.status.ok()) << from << ": " << result.status.cause;
    for (const WatchedResult& watched : result.constraints.watched)
      EXPECT_LE(watched.violation, watched.tolerance) << from << ": " << watched.signal;
    EXPECT_NEAR(result.best.rho[2], 0.0, 1e-3) << "the load takes nothing in a whole turn";
    const bool is_lightest = std::abs(result.best.rho[0] - 9.534) < 1e-3;
    EXPECT_TRUE(is_lightest || result.termination == "stopped_early") << from;
  }
}

}  // namespace
}  // namespace codesign
