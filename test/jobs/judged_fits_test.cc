// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/judged_fits.h"

#include <gtest/gtest.h>

#include "identification/identify.h"
#include "identification/swinging_arm.h"
#include "jobs/identification_records.h"
#include "mechanism_codesign/error.h"

namespace codesign {
namespace {

SourceText judged(const std::string& name, const std::string& more, bool is_fitted,
                  const std::string& data = "{csv: data.csv}") {
  const Problem problem = swinging_problem(data, more);
  SwingingRig rig;
  rig.offset = 0.2;
  StudyRecordings recordings;
  recordings.data = {rig.record("identify.data[0]")};
  const IdentificationResult result = is_fitted ? identify(problem, recordings, {}, nullptr)
                                                : evaluate_model(problem, recordings, nullptr);
  return {name, to_text(identification_json(problem, result))};
}

TEST(JudgedFits, AreReadAsTheyWereWritten) {
  const JudgedModel model = read_judged_model(judged("a.json", "", true));
  EXPECT_EQ(model.numbers, (std::vector<std::string>{"inertia", "viscous"}));
  EXPECT_EQ(model.rank, 2);
  EXPECT_GE(model.inflation, 1.0);
  EXPECT_TRUE(model.is_squares);
  ASSERT_EQ(model.data.size(), 1U);
  EXPECT_EQ(model.data[0].name, "hinge");
  EXPECT_GT(model.samples, 500);
  EXPECT_FALSE(read_judged_model(judged("b.json", "  loss: {type: huber}\n", true)).is_squares);
  EXPECT_TRUE(read_judged_model(judged("c.json", "", false)).numbers.empty());
}

TEST(JudgedFits, AreComparedInNumbersAndWords) {
  const std::string offset = "  joints: {hinge: {offset: {}}}\n";
  const Json comparison =
      comparison_json(judged("small.json", "", true), judged("large.json", offset, true));
  EXPECT_EQ(comparison["larger"], "here");
  EXPECT_EQ(comparison["degrees"], 1);
  EXPECT_LT(comparison["probability"].get<double>(), 1e-6);
  EXPECT_GT(comparison["data"]["hinge"]["rms"][0], comparison["data"]["hinge"]["rms"][1]);
  const std::vector<std::string> sentences = comparison_sentences(comparison);
  ASSERT_EQ(sentences.size(), 3U);
  EXPECT_NE(sentences[1].find("lower: this model"), std::string::npos) << sentences[1];
  EXPECT_NE(sentences[2].find("of the further number here"), std::string::npos) << sentences[2];
}

TEST(JudgedFits, RefusalsAreTold) {
  const Json comparison = comparison_json(judged("a.json", "", true),
                                          judged("b.json", "  loss: {type: huber}\n", true));
  EXPECT_FALSE(comparison.contains("criterion"));
  EXPECT_NE(comparison_sentences(comparison).back().find("robust"), std::string::npos);
}

TEST(JudgedFits, BoundsAtRestAreKnownFromTheFile) {
  const std::string bounds = "{csv: data.csv, mask: {speed: 0.01, rest: bounds}}",
                    left_out = "{csv: data.csv, mask: {speed: 0.01}}";
  EXPECT_TRUE(read_judged_model(judged("a.json", "", true, bounds)).has_rest_bounds);
  EXPECT_FALSE(read_judged_model(judged("b.json", "", true, left_out)).has_rest_bounds);
}

TEST(JudgedFits, OtherFilesAreRefusedByName) {
  for (const char* text : {"", "{", "[]", "{\"inflation\": 1}", "{\"parameters\": {}}"}) {
    try {
      read_judged_model({"some.json", text});
      FAIL() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.fault().where.file, "some.json");
    }
  }
}

}  // namespace
}  // namespace codesign
