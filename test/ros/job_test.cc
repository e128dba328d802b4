// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/job.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace codesign
