// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_robust.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

const std::string kUncertainStudy = kLeastStudy + "uncertain: {rod_length: {uniform: [0.2, 0.4]}}\n";
const std::string kTwoRuns = kLeastStudy + "runs: {short: {set: {rod_length: 0.2}}, long: {set: {rod_length: 0.4}}}\n";

RobustOptions robust_of(const std::string& text) { return read_text(kUncertainStudy + "robust: " + text + "\n").ensemble.robust.value(); }

void expect_bad_robust(const std::string& text, const std::string& element, const std::string& message) {
  expect_fault(kUncertainStudy + "robust: " + text + "\n", element, message, 4);
}

TEST(StudyRobust, ReadsAllKeys) {
  const RobustOptions options =
      robust_of("{measure: cvar, level: 0.75, samples: 64, sampler: random, seed: 0, validate: 1000, failed: tail}");
  EXPECT_EQ(options.measure, RobustMeasure::kCvar);
  EXPECT_EQ(options.level, 0.75);
  EXPECT_EQ(options.samples, 64);
  EXPECT_EQ(options.sampler, SamplerKind::kRandom);
  EXPECT_EQ(options.seed, 0U);
  EXPECT_EQ(options.validate, 1000);
  EXPECT_EQ(options.failed, FailedSamples::kTail);
  EXPECT_EQ(options.where.line, 4);
  EXPECT_EQ(robust_of("{measure: mean_plus_deviation, factor: 0}").factor, 0.0);
  EXPECT_EQ(robust_of("{measure: worst}").measure, RobustMeasure::kWorst);
}

TEST(StudyRobust, TheRestHasDefaults) {
  const RobustOptions options = robust_of("{}");
  EXPECT_EQ(options.measure, RobustMeasure::kMean);
  EXPECT_EQ(options.level, 0.9);
  EXPECT_EQ(options.factor, 1.0);
  EXPECT_EQ(options.samples, 32);
  EXPECT_EQ(options.sampler, SamplerKind::kSobol);
  EXPECT_EQ(options.seed, 1U);
  EXPECT_EQ(options.validate, 0);
  EXPECT_EQ(options.failed, FailedSamples::kRefuse);
}

TEST(StudyRobust, MayBeLeftOut) {
  const RobustOptions uncertain = read_text(kUncertainStudy).ensemble.robust.value();
  EXPECT_EQ(uncertain.measure, RobustMeasure::kMean);
  EXPECT_EQ(uncertain.samples, 32);
  EXPECT_EQ(uncertain.where.line, 3);
  EXPECT_EQ(read_text(kTwoRuns).ensemble.robust.value().samples, 1);
  EXPECT_EQ(read_text(kTwoRuns + "robust: {measure: worst}\n").ensemble.robust.value().samples, 1);
  EXPECT_FALSE(read_text(kLeastStudy).ensemble.robust.has_value());
}

TEST(StudyRobust, NeedsSomethingToBeRobustAgainst) {
  expect_fault(kLeastStudy + "robust: {measure: worst}\n", "robust", "nothing to be robust against", 3);
  for (const char* key : {"samples: 8", "sampler: sobol", "seed: 1", "validate: 10"}) {
    const std::string text = key;
    expect_fault(kTwoRuns + "robust: {" + text + "}\n", "robust." + text.substr(0, text.find(':')), "no meaning without uncertain", 4);
  }
}

TEST(StudyRobust, RefusesBadValues) {
  expect_bad_robust("{measure: median}", "robust.measure", "unknown measure");
  expect_bad_robust("{measure: worst, level: 0.9}", "robust.level", "level belongs to cvar");
  expect_bad_robust("{level: 0.9}", "robust.level", "level belongs to cvar");
  expect_bad_robust("{measure: cvar, level: 0}", "robust.level", "out of range");
  expect_bad_robust("{measure: cvar, level: 1}", "robust.level", "out of range");
  expect_bad_robust("{measure: cvar, factor: 1}", "robust.factor", "factor belongs to mean_plus_deviation");
  expect_bad_robust("{measure: mean_plus_deviation, factor: -1}", "robust.factor", "out of range");
  expect_bad_robust("{samples: 0}", "robust.samples", "out of range");
  expect_bad_robust("{samples: 100001}", "robust.samples", "out of range");
  expect_bad_robust("{samples: 1.5}", "robust.samples", "not an integer");
  expect_bad_robust("{sampler: halton}", "robust.sampler", "unknown sampler");
  expect_bad_robust("{seed: -1}", "robust.seed", "out of range");
  expect_bad_robust("{validate: -1}", "robust.validate", "out of range");
  expect_bad_robust("{validate: 1000001}", "robust.validate", "out of range");
  expect_bad_robust("{failed: ignore}", "robust.failed", "unknown failed");
  expect_bad_robust("{measures: cvar}", "robust.measures", "did you mean \"measure\"");
  expect_bad_robust("cvar", "robust", "expected a map");
}

}  // namespace
}  // namespace codesign
