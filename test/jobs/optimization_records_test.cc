// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/optimization_records.h"

#include <gtest/gtest.h>

#include "jobs/json.h"
#include "jobs/tuned_pendulum.h"

namespace codesign {
namespace {

TEST(OptimizationRecords, HoldBothDesigns) {
  const Problem problem = pendulum();
  const OptimizationResult result = optimize(problem);
  const Json object = optimization_json(problem, result);
  EXPECT_EQ(object["objective"], result.objective);
  EXPECT_EQ(object["initial_parameters"]["length"], 0.5);
  EXPECT_EQ(object["parameters"]["length"], result.rho[0]);
  EXPECT_EQ(object["parameters"].size(), 3U) << "those that are not tuned, too";
  EXPECT_EQ(object["gradient"]["Kp"], result.gradient[1]);
}

TEST(OptimizationRecords, ASearchWithoutAStartHasNoDesign) {
  const Problem problem = pendulum();
  OptimizationResult result;
  result.status.code = StatusCode::kAssemblyFailed;
  result.termination = "start_failed";
  EXPECT_FALSE(has_design(problem, result));
  const Json object = optimization_json(problem, result);
  EXPECT_FALSE(object.contains("parameters"));
  EXPECT_EQ(object["termination"], "start_failed");
}

}  // namespace
}  // namespace codesign
