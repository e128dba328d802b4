// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

OptimizationResult result_at(const Problem& problem, double length, double gain) {
  OptimizationResult result;
  result.initial.rho = problem.start();
  result.best.rho = Eigen::Vector2d(length, gain);
  result.best.gradient = Eigen::Vector2d::Ones();
  result.cost.evaluations = 1;
  return result;
}

TEST(ParameterRecords, TellWhatLiesOnABound) {
  const Problem problem = pendulum();
  const Json table = parameter_table(problem, result_at(problem, 0.3, 4.0));
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(table[0]["name"], "length");
  EXPECT_EQ(table[0]["unit"], "m");
  EXPECT_EQ(table[0]["bound"], "lower");
  EXPECT_EQ(table[0]["initial"], 0.5);
  EXPECT_EQ(table[0]["value"], 0.3);
  EXPECT_EQ(table[1]["name"], "mass");
  EXPECT_FALSE(table[1]["tuned"].get<bool>());
  EXPECT_EQ(table[2]["bound"], "");
  EXPECT_EQ(table[2]["upper"], 5.0);
}

TEST(ParameterRecords, TheGradientAgreesWithItsReference) {
  const Problem problem = pendulum();
  OptimizationResult result = result_at(problem, 0.5, 1.0);
  result.cost.statistics.cpu_seconds = 0.0;  // else a slow machine leaves the check out
  const Json check = gradient_check_json(problem, result, nullptr);
  EXPECT_EQ(check["method"], "complex_step");
  EXPECT_EQ(check["gradient"].size(), 2U);
  EXPECT_EQ(check["directions"], 1);
  EXPECT_LT(check["largest_relative_difference"].get<double>(), 1e-8);
}

TEST(ParameterRecords, ALongCheckIsLeftOut) {
  const Problem problem = pendulum();
  OptimizationResult result = result_at(problem, 0.5, 1.0);
  result.cost.statistics.cpu_seconds = 10.0;
  EXPECT_NE(
      gradient_check_json(problem, result, nullptr)["skipped"].get<std::string>().find("420 s"),
      std::string::npos);
  result.status.code = StatusCode::kCancelled;
  EXPECT_EQ(gradient_check_json(problem, result, nullptr)["skipped"], "the search was interrupted");
}

}  // namespace

}  // namespace codesign
