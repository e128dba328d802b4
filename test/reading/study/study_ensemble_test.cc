// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include "description/study.h"
#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

EngineOptions engine_of(const std::string& text) {
  return read_text(kLeastStudy + "engine: " + text + "\n").ensemble.engine;
}

TEST(StudyEnsemble, ReadsAllBlocks) {
  const EnsembleDescription ensemble = read_text(kLeastStudy + R"(
parameters: {crank_length: {}, payload: {initial: 1.0, lower: 0.0, upper: 5.0, tune: false}}
runs: {empty: {set: {payload: 0.0}}, loaded: {set: {payload: 5.0}, gravity: [0, 0, 0], weight: 2.0}}
uncertain: {rod_length: {uniform: [0.2, 0.4]}, friction_law: {choice: [brown_mcphee, gonthier]}}
robust: {measure: cvar, level: 0.9, samples: 32, sampler: sobol, seed: 1, validate: 1000}
multistart: {starts: 100, sampler: sobol, seed: 1, screen: 400, cluster: 1.0e-4}
engine: {type: threads, workers: 8}
)")
                                           .ensemble;
  EXPECT_TRUE(ensemble.is_ensemble());
  EXPECT_EQ(ensemble.runs.size(), 2U);
  EXPECT_EQ(ensemble.uncertain.size(), 2U);
  EXPECT_EQ(ensemble.robust.value().measure, RobustMeasure::kCvar);
  EXPECT_EQ(ensemble.multistart.starts, 100);
  EXPECT_EQ(ensemble.engine.workers, 8);
}

TEST(StudyEnsemble, TheBlocksMayBeLeftOut) {
  const EnsembleDescription ensemble = read_text(kLeastStudy).ensemble;
  EXPECT_FALSE(ensemble.is_ensemble());
  EXPECT_FALSE(ensemble.robust.has_value());
  EXPECT_EQ(ensemble.multistart.starts, 0);
  EXPECT_EQ(ensemble.engine.kind, EngineKind::kThreads);
  EXPECT_EQ(ensemble.engine.workers, 0);
}

TEST(StudyEnsemble, ReadsTheEngine) {
  EXPECT_EQ(engine_of("{type: serial}").kind, EngineKind::kSerial);
  EXPECT_EQ(engine_of("{type: threads}").workers, 0);
  EXPECT_EQ(engine_of("{workers: 4096}").workers, 4096);
  EXPECT_EQ(engine_of("{type: mpi}").kind, EngineKind::kMpi);
}

TEST(StudyEnsemble, KnowsWhetherAnEngineIsAskedFor) {
  EXPECT_EQ(engine_of("{type: threads}").where.line, 3);
  EXPECT_EQ(engine_of("{workers: 2}").where.line, 3);
  EXPECT_EQ(engine_of("{}").where.file, "");
  EXPECT_EQ(read_text(kLeastStudy).ensemble.engine.where.file, "");
}

const std::string kUncertainStudy =
    kLeastStudy + "uncertain: {rod_length: {uniform: [0.2, 0.4]}}\n";
const std::string kTwoRuns =
    kLeastStudy + "runs: {short: {set: {rod_length: 0.2}}, long: {set: {rod_length: 0.4}}}\n";

RobustOptions robust_of(const std::string& text) {
  return read_text(kUncertainStudy + "robust: " + text + "\n").ensemble.robust.value();
}

TEST(StudyRobust, ReadsAllKeys) {
  const RobustOptions options = robust_of(
      "{measure: cvar, level: 0.75, samples: 64, sampler: random, seed: 0, validate: 1000, failed: "
      "tail}");
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

const std::string kTunedStudy =
    kLeastStudy + "parameters: {crank_length: {}, Kp: {initial: 1, lower: 0, upper: 2}}\n";

MultistartOptions multistart_of(const std::string& text) {
  return read_text(kTunedStudy + "multistart: " + text + "\n").ensemble.multistart;
}

void expect_bad_multistart(const std::string& text, const std::string& element,
                           const std::string& message) {
  expect_fault(kTunedStudy + "multistart: " + text + "\n", element, message, 4);
}

TEST(StudyMultistart, ReadsAllKeys) {
  const MultistartOptions options =
      multistart_of("{starts: 100, sampler: latin_hypercube, seed: 5, screen: 300, cluster: 1e-3}");
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
  EXPECT_EQ(fault_in(kTunedStudy + "multistart: {starts: 10, screen: 9}").allowed,
            "a whole number from 10 to 10000000");
  expect_bad_multistart("{starts: 10, cluster: 0}", "multistart.cluster", "out of range");
  expect_bad_multistart("{starts: 10, cluster: 1}", "multistart.cluster", "out of range");
  expect_bad_multistart("{starts: 10, sampler: grid}", "multistart.sampler", "unknown sampler");
  expect_bad_multistart("{starts: 10, seed: 0.5}", "multistart.seed", "not an integer");
  expect_bad_multistart("{starts: 10, screens: 40}", "multistart.screens",
                        "did you mean \"screen\"");
}

TEST(StudyMultistart, NeedsBoundsOfAllTunedParameters) {
  const std::string start = "\nmultistart: {starts: 10}\n";
  expect_fault(
      kLeastStudy +
          "parameters:\n  crank_length: {}\n  Ki: {initial: 1, lower: 0}\n  Kp: {initial: 1}" +
          start,
      "parameters.Ki", "finite bounds of all tuned parameters, and this one has [0, inf]", 5);
  expect_fault(
      kLeastStudy +
          "controllers: {push: {type: basis, output: crank_joint, coefficients: {count: 2}}}" +
          start,
      "parameter push_c0", "finite bounds", 3);
  expect_fault(kLeastStudy + "parameters: {Kp: {initial: 1, tune: false}}" + start, "multistart",
               "tunes nothing", 4);
  const Study study = read_text(
      kLeastStudy + "parameters: {crank_length: {}, Kp: {initial: 1, tune: false}}" + start);
  EXPECT_EQ(study.ensemble.multistart.starts, 10);
}

}  // namespace
}  // namespace codesign
