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

/// a^2 + 2 b^2 from (0.5, 3) by a mechanism that rests.
OptimizationResult nearest(const std::string& constraints, const std::string& more) {
  const std::string wheel = kFlywheel;
  const std::string study =
      "duration: 0.01\nparameters: {a: {initial: 0.5, lower: -10, upper: 10}, b: {initial: 3, "
      "lower: -10, upper: 10}}\nobjective:\n  terminal:\n"
      "    - {signal: \"${a + 0*shaft/position}\"}\n"
      "    - {signal: \"${b + 0*shaft/position}\", weight: 2}\nconstraints: [" +
      constraints + "]\n" + more;
  return optimize(load_problem({"flywheel.urdf", wheel}, {}, {"study.yaml", study}));
}

// On a + b = 3 the multiplier is 2 a = 4 b.
TEST(Minimization, AnEqualityAmongParametersIsKept) {
  for (const char* text :
       {"\"a + b == 3\"", "\"3 == a + b\"", "{expression: \"${a + b}\", between: [3, 3]}"})
    for (const char* algorithm : {"auto", "slsqp", "cobyla", "auglag_lbfgs"}) {
      const OptimizationResult result = nearest(
          text, std::string("optimizer: {max_evaluations: 1000, algorithm: ") + algorithm + "}\n");
      ASSERT_TRUE(result.status.ok()) << text << algorithm << ": " << result.status.cause;
      EXPECT_NEAR(result.best.rho[0], 2.0, 2e-3) << text << algorithm;
      EXPECT_NEAR(result.best.rho[0] + result.best.rho[1], 3.0, 1e-7) << text << algorithm;
      ASSERT_EQ(result.constraints.margins.size(), 1);
      EXPECT_NEAR(result.constraints.margins[0], 0.0, 1e-7);
      EXPECT_LE(result.optimality.flat_directions.cols(), 0);
    }
  const OptimizationResult curved = nearest("\"a*b == 4\", \"b >= 1.9\"", "");
  ASSERT_TRUE(curved.status.ok()) << curved.status.cause;
  EXPECT_NEAR(curved.best.rho[1], 1.9, 1e-6) << "without the bound b^4 = 8";
  EXPECT_NEAR(curved.best.rho.prod(), 4.0, 1e-6);
  const OptimizationResult starts =
      nearest("\"a + b == 3\"", "multistart: {starts: 2, screen: 8}\n");
  ASSERT_TRUE(starts.status.ok()) << starts.status.cause;
  EXPECT_NEAR(starts.best.rho[0], 2.0, 1e-4);
  EXPECT_EQ(nearest("\"a + b == 3\", \"a + b == 4\"", "").status.code, StatusCode::kInfeasible);
}

TEST(Minimization, AlgorithmsWithoutEqualitiesSaySo) {
  for (const char* algorithm : {"mma", "ccsaq"})
    EXPECT_THROW(
        nearest("\"a + b == 3\"", std::string("optimizer: {algorithm: ") + algorithm + "}\n"),
        InputError)
        << algorithm;
}

}  // namespace
}  // namespace codesign
