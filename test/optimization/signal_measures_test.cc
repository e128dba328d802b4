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

// The mass is in the band from pi/3/w on, for as long again: the longest stay is the slowest swing
// that arrives in time.
TEST(SearchWithMeasures, TheLongestDwellAfterAnEarlyArrival) {
  const std::string band = "slide/position, band: [-0.5, 0.5]";
  const Problem problem = oscillator("duration: 1.35\nobjective: {dwell: [{signal: " + band +
                                         ", weight: -1}]}\nconstraints: [{arrival: " + band +
                                         ", before: 0.69, at_most: 0.4}]\n",
                                     "{initial: 1.0, tune: false}");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  EXPECT_NEAR(result.best.objective, -0.4, 1e-6);
  EXPECT_NEAR(result.best.rho[0], std::pow(kPi / 1.2, 2), 1e-4);
  ASSERT_EQ(result.constraints.watched.size(), 2U);
  EXPECT_EQ(result.constraints.watched[0].signal, "arrival of slide/position");
  EXPECT_NEAR(result.constraints.watched[0].largest, 0.4, 1e-6);
  EXPECT_NEAR(result.constraints.watched[0].initial_largest, kPi / 6.0, 1e-8);
}

// x = a cos(w t) and x v = -a^2 w/2 sin(2 w t).
TEST(SearchWithExpressions, TheLargestAmplitudeWithinBounds) {
  const struct {
    const char* bound;
    double amplitude, k;
  } cases[] = {
      {"path: [{signal: \"${slide/position^2}\", at_most: 0.49}]\n", 0.7, 0.0},
      {"constraints: [{stroke: \"${slide/position^2}\", at_most: 0.64}]\n", 0.8, 0.0},
      {"constraints: [{maximum: \"${3*slide/position - t*0}\", at_most: 2.7}]\n", 0.9, 0.0},
      // The slowest swing has the smallest peak of the product.
      {"constraints: [{peak: \"${slide/position*slide/velocity}\", at_most: 0.36}]\n",
       std::sqrt(0.45), 2.56}};
  for (const auto& test : cases) {
    const OptimizationResult result = found(
        "duration: 5\nobjective: {maximum: [{signal: \"${2*slide/position}\", weight: -1}]}\n" +
        std::string(test.bound));
    ASSERT_TRUE(result.status.ok()) << test.bound << result.status.cause;
    EXPECT_NEAR(result.best.objective, -2.0 * test.amplitude, 1e-6) << test.bound;
    EXPECT_NEAR(result.best.rho[1], test.amplitude, 1e-6) << test.bound;
    if (test.k > 0.0) {
      EXPECT_NEAR(result.best.rho[0], test.k, 1e-6) << test.bound;
    }
  }
}

// cos(0.4 w)^2 = 1/2 at the end, where v^2 is largest.
TEST(SearchWithExpressions, AnEqualityAtTheEndAndAPeak) {
  const Problem problem = oscillator(
      "duration: 0.4\nobjective: {peak: [{signal: \"${slide/velocity^2}\"}]}\n"
      "final: [{signal: \"${slide/position^2}\", between: [0.5, 0.5]}]\n",
      "{initial: 1.0, tune: false}");
  const OptimizationResult result = optimize(problem);
  ASSERT_TRUE(result.status.ok()) << result.status.cause;
  const double w = kPi / 1.6;
  EXPECT_NEAR(result.best.rho[0], w * w, 1e-5);
  EXPECT_NEAR(result.best.objective, 0.5 * w * w, 1e-5);
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
