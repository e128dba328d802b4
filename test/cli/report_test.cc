// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "cli/report.h"

#include <gtest/gtest.h>

#include <sstream>

#include "jobs/json.h"
#include "mechanism_codesign/version.h"

namespace codesign::cli {
namespace {

struct Finished {
  int code = -1;
  std::string out, err;
};

Finished finish_with(const Status& status, bool json, const std::vector<Failure>& failures = {}) {
  std::ostringstream out, err;
  const std::atomic<bool> cancel{false};
  Arguments arguments;
  arguments.command = "simulate";
  arguments.json = json;
  Finished finished;
  finished.code = finish(arguments, status, {{"objective", 0.5}}, {out, err, cancel}, failures);
  finished.out = out.str();
  finished.err = err.str();
  return finished;
}

const Status kStopped{StatusCode::kTooManySteps, 0.25, "500 steps taken"};

TEST(Report, DescribesStatusTimeAndCause) {
  EXPECT_EQ(describe(kStopped), "too_many_steps at t = 0.25 s: 500 steps taken");
  EXPECT_EQ(describe({StatusCode::kCancelled, 1.0, ""}), "cancelled at t = 1 s");
}

TEST(Report, SuccessIsSilentButForJson) {
  const Finished plain = finish_with({}, false);
  EXPECT_EQ(plain.code, kDone);
  EXPECT_EQ(plain.out + plain.err, "");
  EXPECT_EQ(Json::parse(finish_with({}, true).out), Json({{"version", version()}, {"objective", 0.5}}));
}

TEST(Report, FailureKeepsWhatIsKnown) {
  const Finished failed = finish_with(kStopped, true);
  EXPECT_EQ(failed.code, kFailed);
  EXPECT_EQ(failed.err, "codesign simulate: too_many_steps at t = 0.25 s: 500 steps taken\n");
  Json object = Json::parse(failed.out);
  EXPECT_EQ(object["objective"], 0.5);
  EXPECT_EQ(object["error"]["code"], "too_many_steps");
}

TEST(Report, WhatGoesWrongBesideTheComputationIsAFailureToo) {
  const Finished finished = finish_with({}, true, {{"output_failed", "a: cannot be written"}, {"cancelled", "b ends early"}});
  EXPECT_EQ(finished.code, kFailed);
  EXPECT_EQ(finished.err, "codesign simulate: a: cannot be written\ncodesign simulate: b ends early\n");
  const Json object = Json::parse(finished.out);
  EXPECT_EQ(object["objective"], 0.5);
  EXPECT_EQ(object["error"]["code"], "output_failed");
  EXPECT_EQ(object["error"]["message"], "a: cannot be written; b ends early");
}

TEST(Report, TheComputationsStatusComesFirst) {
  const Json object = Json::parse(finish_with(kStopped, true, {{"output_failed", "a: cannot be written"}}).out);
  EXPECT_EQ(object["error"]["code"], "too_many_steps");
  EXPECT_EQ(object["error"]["message"], "500 steps taken; a: cannot be written");
}

}  // namespace
}  // namespace codesign::cli
