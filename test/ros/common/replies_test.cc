// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/common/replies.h"

#include <gtest/gtest.h>
#include <mechanism_codesign/EvaluateResponse.h>
#include <mechanism_codesign/Optimize.h>
#include <mechanism_codesign/OptimizeGoal.h>
#include <mechanism_codesign/OptimizeResult.h>

namespace codesign {
namespace {

TEST(Job, AStatusIsSaidAsCodeAndSentence) {
  mechanism_codesign::EvaluateResponse reply;
  set_status(Status(), &reply);
  EXPECT_TRUE(reply.success);
  EXPECT_EQ(reply.code, "success");
  EXPECT_EQ(reply.message, "");
  EXPECT_EQ(reply.version, version());
  set_status({StatusCode::kTooManySteps, 0.25, "more than 3 steps"}, &reply);
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.code, "too_many_steps");
  EXPECT_EQ(reply.message.rfind("more than 3 steps (at t = 0.25", 0), 0U) << reply.message;
}

TEST(Job, ARefusalNamesItsReason) {
  mechanism_codesign::OptimizeResult reply;
  refuse("busy", "ask again later", &reply);
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.code, "busy");
  EXPECT_EQ(reply.message, "ask again later");
  EXPECT_EQ(reply.version, version());
}

// Compiling this checks that the service and the action have the same fields.
TEST(Wire, ARequestBecomesAGoal) {
  mechanism_codesign::OptimizeRequest request;
  request.parameters = {"a", "b"};
  request.start = {1.0, 2.0};
  request.max_evaluations = 7;
  request.algorithm = "mma";
  request.relative_tolerance = 1e-3;
  const auto goal = same_fields<mechanism_codesign::OptimizeGoal>(request);
  EXPECT_EQ(goal.parameters, request.parameters);
  EXPECT_EQ(goal.start, request.start);
  EXPECT_EQ(goal.max_evaluations, 7U);
  EXPECT_EQ(goal.algorithm, "mma");
  EXPECT_EQ(goal.relative_tolerance, 1e-3);
}

TEST(Wire, AResultBecomesAResponse) {
  mechanism_codesign::OptimizeResult result;
  result.success = 1;
  result.tuned = {0.5};
  result.cpu_seconds = 2.0;
  result.bag = "x.bag";
  const auto response = same_fields<mechanism_codesign::OptimizeResponse>(result);
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.tuned, result.tuned);
  EXPECT_EQ(response.cpu_seconds, 2.0);
  EXPECT_EQ(response.bag, "x.bag");
}

}  // namespace
}  // namespace codesign
