// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ensemble/worst_point.h"

#include <gtest/gtest.h>

#include "ensemble/ensemble_fixture.h"
#include "problem/load_problem.h"

namespace codesign {
namespace {

WorstPoint worst_of(const std::string& uncertain, int samples,
                    const std::atomic<bool>* cancel = nullptr) {
  const Problem problem =
      block("uncertain: {" + uncertain +
            "}\nrobust: {measure: worst, samples: " + std::to_string(samples) + "}\n");
  const Ensemble ensemble(problem);
  return find_worst_point(problem, ensemble, problem.start(),
                          ensemble.evaluate(problem.start(), false).values, cancel);
}

// A heavier block swings further, and is the less braked the smoother the ground is.
TEST(WorstPoint, IsFoundAtTheEndsOfIntervals) {
  const WorstPoint found = worst_of("mu: {uniform: [0.2, 0.4]}, mass: {uniform: [1, 3]}", 2);
  ASSERT_TRUE(found.is_known);
  EXPECT_TRUE(found.status.ok());
  const WorstPoint fine = worst_of("mu: {uniform: [0.2, 0.4]}, mass: {uniform: [1, 3]}", 400);
  EXPECT_GE(found.objective, (1.0 - 1e-6) * fine.objective);
  for (const auto& [parameter, value] : found.scenario.values)
    EXPECT_TRUE(value >= 0.2 && value <= 3.0) << parameter;
}

TEST(WorstPoint, NeedsAnInterval) {
  EXPECT_FALSE(worst_of("mu: {choice: [0.2, 0.4]}", 4).is_known);
  EXPECT_FALSE(worst_of("mu: {normal: [0.3, 0.1]}", 4).is_known);
  EXPECT_FALSE(worst_of("mu: {uniform: [0.2, 0.4]}", 1).is_known) << "the nominal sample alone";
}

TEST(WorstPoint, IsInterrupted) {
  const std::atomic<bool> cancel{true};
  EXPECT_EQ(worst_of("mu: {uniform: [0.2, 0.4]}", 4, &cancel).status.code, StatusCode::kCancelled);
}

}  // namespace
}  // namespace codesign
