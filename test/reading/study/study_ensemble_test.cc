// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_ensemble.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

EngineOptions engine_of(const std::string& text) { return read_text(kLeastStudy + "engine: " + text + "\n").ensemble.engine; }

void expect_refused(const std::string& text, const std::string& element, const std::string& message) {
  expect_fault(kLeastStudy + "engine: " + text + "\n", element, message, 3);
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

TEST(StudyEnsemble, RefusesOtherEngines) {
  expect_refused("{type: mpi, workers: 2}", "engine.workers", "mpirun says how many workers the engine mpi has");
  expect_refused("{type: thread}", "engine.type", "did you mean \"threads\"");
  expect_refused("{type: serial, workers: 2}", "engine.workers", "the engine serial has no workers");
  expect_refused("{workers: 0}", "engine.workers", "out of range");
  expect_refused("{workers: 4097}", "engine.workers", "out of range");
  expect_refused("{threads: 4}", "engine.threads", "unknown key");
  expect_refused("serial", "engine", "expected a map");
}

}  // namespace
}  // namespace codesign
