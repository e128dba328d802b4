// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_multistart.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

const std::string kTunedStudy = kLeastStudy + "parameters: {crank_length: {}, Kp: {initial: 1, lower: 0, upper: 2}}\n";

MultistartOptions multistart_of(const std::string& text) {
  return read_text(kTunedStudy + "multistart: " + text + "\n").ensemble.multistart;
}

void expect_bad_multistart(const std::string& text, const std::string& element, const std::string& message) {
  expect_fault(kTunedStudy + "multistart: " + text + "\n", element, message, 4);
}

TEST(StudyMultistart, ReadsAllKeys) {
  const MultistartOptions options = multistart_of("{starts: 100, sampler: latin_hypercube, seed: 5, screen: 300, cluster: 1e-3}");
  EXPECT_EQ(options.starts, 100);
  EXPECT_EQ(options.sampler, SamplerKind::kLatinHypercube);
  EXPECT_EQ(options.seed, 5U);
  EXPECT_EQ(options.screen, 300);
  EXPECT_EQ(options.cluster, 1e-3);
  EXPECT_EQ(options.where.line, 4);
}

TEST(StudyMultistart, TheRestHasDefaults) {
  const MultistartOptions options = multistart_of("{starts: 7}");
  EXPECT_EQ(options.sampler, SamplerKind::kSobol);
  EXPECT_EQ(options.seed, 1U);
  EXPECT_EQ(options.screen, 28);
  EXPECT_EQ(options.cluster, 1e-4);
  EXPECT_EQ(read_text(kTunedStudy).ensemble.multistart.starts, 0);
}

TEST(StudyMultistart, RefusesBadValues) {
  expect_bad_multistart("{}", "multistart.starts", "required key is missing");
  expect_bad_multistart("{starts: 0}", "multistart.starts", "out of range");
  expect_bad_multistart("{starts: 100001}", "multistart.starts", "out of range");
  expect_bad_multistart("{starts: 10, screen: 9}", "multistart.screen", "out of range");
  EXPECT_EQ(fault_in(kTunedStudy + "multistart: {starts: 10, screen: 9}").allowed, "a whole number from 10 to 10000000");
  expect_bad_multistart("{starts: 10, cluster: 0}", "multistart.cluster", "out of range");
  expect_bad_multistart("{starts: 10, cluster: 1}", "multistart.cluster", "out of range");
  expect_bad_multistart("{starts: 10, sampler: grid}", "multistart.sampler", "unknown sampler");
  expect_bad_multistart("{starts: 10, seed: 0.5}", "multistart.seed", "not an integer");
  expect_bad_multistart("{starts: 10, screens: 40}", "multistart.screens", "did you mean \"screen\"");
}

TEST(StudyMultistart, NeedsBoundsOfAllTunedParameters) {
  const std::string start = "\nmultistart: {starts: 10}\n";
  expect_fault(kLeastStudy + "parameters:\n  crank_length: {}\n  Ki: {initial: 1, lower: 0}\n  Kp: {initial: 1}" + start, "parameters.Ki",
               "finite bounds of all tuned parameters, and this one has [0, inf]", 5);
  expect_fault(kLeastStudy + "controllers: {push: {type: basis, output: crank_joint, coefficients: {count: 2}}}" + start,
               "parameter push_c0", "finite bounds", 3);
  expect_fault(kLeastStudy + "parameters: {Kp: {initial: 1, tune: false}}" + start, "multistart", "tunes nothing", 4);
  const Study study = read_text(kLeastStudy + "parameters: {crank_length: {}, Kp: {initial: 1, tune: false}}" + start);
  EXPECT_EQ(study.ensemble.multistart.starts, 10);
}

}  // namespace
}  // namespace codesign
