// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_options.h"

#include "reading/study/study_fixture.h"

namespace codesign {
namespace {

YamlValue parse(const std::string& text) { return YamlValue::parse({"study.yaml", text}); }

std::string message_of(const std::string& text) {
  try {
    int count = 0;
    OptionReader{parse(text)}("count", OptionRange{1, 10}, count);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OptionReader, AMissingKeyChangesNothing) {
  int count = 7;
  RobustOptions options;
  options.sampler = SamplerKind::kRandom;
  options.seed = 3;
  OptionReader{parse("{}")}("count", OptionRange{1, 10}, count);
  read_options(parse("{}"), &options);
  EXPECT_EQ(count, 7);
  EXPECT_EQ(options.sampler, SamplerKind::kRandom);
  EXPECT_EQ(options.seed, 3U);
}

TEST(OptionReader, ReadsWholeNumbersWithinARange) {
  int count = 0;
  OptionReader{parse("count: 10")}("count", OptionRange{1, 10}, count);
  EXPECT_EQ(count, 10);
  EXPECT_EQ(message_of("count: 1"), "");
  EXPECT_EQ(
      message_of("count: 0"),
      "study.yaml:1: count: count out of range (value: 0, allowed: a whole number from 1 to 10)");
  EXPECT_NE(message_of("count: 11").find("out of range"), std::string::npos);
  EXPECT_NE(message_of("count: 1e300").find("out of range"), std::string::npos);
  EXPECT_NE(message_of("count: 2.5").find("not an integer"), std::string::npos);
  EXPECT_NE(message_of("count: many").find("not a number"), std::string::npos);
}

TEST(OptionReader, ReadsSamplerAndSeed) {
  RobustOptions options;
  read_options(parse("{sampler: latin_hypercube, seed: 2147483647}"), &options);
  EXPECT_EQ(options.sampler, SamplerKind::kLatinHypercube);
  EXPECT_EQ(options.seed, 2147483647U);
  EXPECT_THROW(read_options(parse("{seed: -1}"), &options), InputError);
  EXPECT_THROW(read_options(parse("{seed: 2147483648}"), &options), InputError);
  EXPECT_THROW(read_options(parse("{sampler: sobel}"), &options), InputError);
}

std::string with_line(const std::string& line) { return kLeastStudy + line + "\n"; }

TEST(StudyOptions, ReadsTheSolver) {
  const SolverOptions solver =
      read_text(with_line("solver: {integrator: idas, method: rodas5p, relative_tolerance: 1e-9, "
                          "absolute_tolerance: 1e-10, "
                          "initial_step: 1e-5, maximum_step: 0.01, maximum_steps: 500, "
                          "maximum_speed: 50, gradient: direct}"))
          .solver;
  EXPECT_EQ(solver.integrator, IntegratorKind::kIdas);
  EXPECT_EQ(solver.method, RosenbrockMethod::kRodas5P);
  EXPECT_EQ(solver.relative_tolerance, 1e-9);
  EXPECT_EQ(solver.absolute_tolerance, 1e-10);
  EXPECT_EQ(solver.initial_step, 1e-5);
  EXPECT_EQ(solver.maximum_step, 0.01);
  EXPECT_EQ(solver.maximum_steps, 500);
  EXPECT_EQ(solver.maximum_speed, 50.0);
  EXPECT_EQ(solver.gradient, GradientMethod::kDirect);
  EXPECT_EQ(read_text(kLeastStudy).solver.gradient, GradientMethod::kAuto);
}

TEST(StudyOptions, ReadsTheOptimizer) {
  const OptimizerOptions optimizer =
      read_text(
          with_line("optimizer: {algorithm: mma, max_evaluations: 7, relative_tolerance: 1e-3}"))
          .optimizer;
  EXPECT_EQ(optimizer.algorithm, "mma");
  EXPECT_EQ(optimizer.max_evaluations, 7);
  EXPECT_EQ(optimizer.relative_tolerance, 1e-3);
}

TEST(StudyOptions, ReadsTheLimits) {
  const LimitOptions none = read_text(kLeastStudy).limits;
  EXPECT_FALSE(none.effort || none.position);
  EXPECT_FALSE(none.stiffness || none.dissipation || none.width) << "follow the machine";
  const LimitOptions limits = read_text(with_line("limits: {effort: true, position: true, "
                                                  "stiffness: 2e3, dissipation: 0, width: 1e-2}"))
                                  .limits;
  EXPECT_TRUE(limits.effort && limits.position);
  EXPECT_EQ(limits.stiffness, 2e3);
  EXPECT_EQ(limits.dissipation, 0.0);
  EXPECT_EQ(limits.width, 1e-2);
}

TEST(StudyOptions, RefusesBadLimits) {
  expect_fault(with_line("limits: {effort: 3}"), "limits.effort", "not a truth value", 3);
  expect_fault(with_line("limits: {stiffness: 0}"), "limits.stiffness", "out of range", 3);
  expect_fault(with_line("limits: {dissipation: -1}"), "limits.dissipation", "out of range", 3);
  expect_fault(with_line("limits: {width: 0}"), "limits.width", "out of range", 3);
  for (const char* key : {"stiffness", "dissipation", "width"})
    expect_fault(with_line("limits: {effort: true, " + std::string(key) + ": 5}"),
                 "limits." + std::string(key), "an option of the stops", 3);
  EXPECT_FALSE(read_text(with_line("limits: {position: false, stiffness: 5}")).limits.position);
  expect_fault(with_line("limits: {positions: true}"), "limits.positions", "unknown key", 3);
}

}  // namespace
}  // namespace codesign
