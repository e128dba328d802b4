// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <limits>
#include <sstream>

#include "cli/report.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "mechanism_codesign/version.h"

namespace codesign::cli {
namespace {

TEST(JsonOutput, DoublesReadBackAsTheSameDoubles) {
  std::ostringstream out;
  print({{"third", 1.0 / 3.0},
         {"small", 5e-324},
         {"infinite", std::numeric_limits<double>::infinity()}},
        out);
  const Json read = Json::parse(out.str());
  EXPECT_EQ(read["third"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(read["small"].get<double>(), 5e-324);
  EXPECT_TRUE(read["infinite"].is_null());
}

TEST(JsonOutput, CountsHaveTheirNames) {
  Counts counts;
  counts.bodies = 3;
  counts.total_equations = 372;
  counts.redundant_rows = {{"pin", 4, "parallel axes, x_i . z_j"}};
  const Json object = record_json(counts);
  EXPECT_EQ(object["bodies"], 3);
  EXPECT_EQ(object["total_equations"], 372);
  EXPECT_EQ(object["redundant_rows"][0]["joint"], "pin");
  EXPECT_EQ(object["redundant_rows"][0]["row"], 4);
  EXPECT_EQ(object["redundant_rows"][0]["kind"], "parallel axes, x_i . z_j");
  for (const char* key :
       {"coordinates", "first_order_equations", "controller_states", "degrees_of_freedom",
        "constraints", "redundant_constraints", "dynamic_equations", "parameters", "sensitivities"})
    EXPECT_TRUE(object.contains(key)) << key;
}

TEST(JsonOutput, ErrorsSayWhereAndWhat) {
  const Json object = to_json(
      InputError({{"study.yaml", 4}, "duration", "must be positive", "-1", "more than 0 s"}));
  EXPECT_EQ(object["code"], "bad_input");
  EXPECT_EQ(object["file"], "study.yaml");
  EXPECT_EQ(object["line"], 4);
  EXPECT_EQ(object["element"], "duration");
  EXPECT_EQ(object["value"], "-1");
  EXPECT_EQ(object["allowed"], "more than 0 s");
  EXPECT_NE(object["message"].get<std::string>().find("must be positive"), std::string::npos);
  const Json status = to_json(Status{StatusCode::kAssemblyFailed, 0.25, "too short"});
  EXPECT_EQ(status["code"], "assembly_failed");
  EXPECT_EQ(status["time"], 0.25);
  EXPECT_EQ(status["message"], "too short");
}

TEST(JsonOutput, StatisticsKeepTheirKeys) {
  Json object;
  add_statistics({12, 3, 0.5, 0.25, 0.125}, &object);
  EXPECT_EQ(
      object.dump(),
      R"({"steps":12,"rejected_steps":3,"explicit_steps":0,"cpu_seconds":0.5,"constraint_drift":0.25,"energy_error":0.125})");
}

TEST(JsonOutput, WarningsSayCodeSentenceAndPlace) {
  const Json array = to_json(
      Warnings{warn("limit_order", {{"arm.urdf", 7}, "<limit>", "lower is above upper", "", ""})});
  ASSERT_EQ(array.size(), 1U);
  EXPECT_EQ(array[0]["code"], "limit_order");
  EXPECT_EQ(array[0]["message"], "arm.urdf:7: <limit>: lower is above upper");
  EXPECT_EQ(array[0]["file"], "arm.urdf");
  EXPECT_EQ(array[0]["line"], 7);
}

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
  EXPECT_EQ(Json::parse(finish_with({}, true).out),
            Json({{"version", version()}, {"objective", 0.5}}));
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
  const Finished finished = finish_with(
      {}, true, {{"output_failed", "a: cannot be written"}, {"cancelled", "b ends early"}});
  EXPECT_EQ(finished.code, kFailed);
  EXPECT_EQ(finished.err,
            "codesign simulate: a: cannot be written\ncodesign simulate: b ends early\n");
  const Json object = Json::parse(finished.out);
  EXPECT_EQ(object["objective"], 0.5);
  EXPECT_EQ(object["error"]["code"], "output_failed");
  EXPECT_EQ(object["error"]["message"], "a: cannot be written; b ends early");
}

TEST(Report, TheComputationsStatusComesFirst) {
  const Json object =
      Json::parse(finish_with(kStopped, true, {{"output_failed", "a: cannot be written"}}).out);
  EXPECT_EQ(object["error"]["code"], "too_many_steps");
  EXPECT_EQ(object["error"]["message"], "500 steps taken; a: cannot be written");
}

}  // namespace

}  // namespace codesign::cli
