// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Searches with strokes, maxima, minima, arrivals and dwells.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanism_codesign/optimization.h"
#include "sensitivity/oscillator.h"

namespace codesign {
namespace {

OptimizationResult found(const std::string& lines) {
  const Problem problem = oscillator(lines);
  return optimize(problem);
}

constexpr double kPi = 3.141592653589793;

// The stroke is twice the amplitude.
TEST(SearchWithMeasures, TheLargestMaximumWithinAStroke) {
  const OptimizationResult result = found(
      "duration: 5\nobjective: {maximum: [{signal: slide/position, weight: -1}]}\n"
      "constraints: [{stroke: slide/position, at_most: 1.0}]\n");
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, -0.5, 1e-6);
  ASSERT_EQ(result.constraints.watched.size(), 2U);
  EXPECT_EQ(result.constraints.watched[0].signal, "stroke of slide/position");
  EXPECT_NEAR(result.constraints.watched[0].largest, 1.0, 1e-6);
  EXPECT_NEAR(result.constraints.watched[0].initial_largest, 2.0, 1e-8);
}

TEST(SearchWithMeasures, TheLeastStrokeThatReachesAHeight) {
  const OptimizationResult result = found(
      "duration: 5\nobjective: {stroke: [{signal: slide/position}]}\n"
      "constraints: [{maximum: slide/position, at_least: 0.7}, {minimum: slide/position, "
      "at_most: -0.6}]\n");
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, 1.4, 1e-6);
  EXPECT_NEAR(result.best.rho[1], 0.7, 1e-6);
}

TEST(SearchWithMeasures, TheEarliestArrivalWithAShortDwell) {
  const std::string band = ", band: [-0.5, 0.5]";
  const Problem problem =
      oscillator("duration: 0.69\nobjective: {arrival: [{signal: slide/position" + band +
                     "}]}\nconstraints: [{dwell: slide/position" + band + ", at_most: 0.29}]\n",
                 "{initial: 1.0, tune: false}");
  const OptimizationResult result = optimize(problem);
  // The run ends within the band: the dwell is what the arrival leaves of 0.69 s.
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, 0.4, 1e-6);
  EXPECT_NEAR(result.best.rho[0], std::pow(kPi / 3.0 / 0.4, 2), 1e-4);
}

TEST(SearchWithMeasures, ABoundThatCannotBeMetIsReported) {
  const OptimizationResult result = found(
      "duration: 5\nobjective: {stroke: [{signal: slide/position}]}\n"
      "constraints: [{minimum: slide/position, at_most: -3}]\n");
  EXPECT_EQ(result.status.code, StatusCode::kInfeasible);
  EXPECT_NE(result.status.cause.find("minimum of slide/position"), std::string::npos)
      << result.status.cause;
}

}  // namespace
}  // namespace codesign
