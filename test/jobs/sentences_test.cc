// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/sentences.h"

#include <gtest/gtest.h>

namespace codesign {
namespace {

TEST(Sentences, NameCodeTimeAndCause) {
  const Status status{StatusCode::kTooManySteps, 0.25, "more than 7 steps"};
  EXPECT_EQ(describe(status), "too_many_steps at t = 0.25 s: more than 7 steps");
  EXPECT_EQ(describe({StatusCode::kCancelled, 1.0, ""}), "cancelled at t = 1 s");
  EXPECT_EQ(reason(status), "more than 7 steps (at t = 0.25 s)");
}

TEST(Sentences, WhatEndedASearchHasNoTimeOfARun) {
  EXPECT_EQ(reason({StatusCode::kCancelled, 0.0, "the best point so far is kept"}), "the best point so far is kept");
  EXPECT_EQ(describe({StatusCode::kInfeasible, 0.0, "outside its constraints"}), "infeasible: outside its constraints");
  EXPECT_EQ(reason({StatusCode::kAssemblyFailed, 0.0, "no way"}), "no way (at t = 0 s)");
}

}  // namespace
}  // namespace codesign
