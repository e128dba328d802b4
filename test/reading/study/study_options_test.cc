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
  EXPECT_EQ(message_of("count: 0"), "study.yaml:1: count: count out of range (value: 0, allowed: a whole number from 1 to 10)");
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
      read_text(with_line("solver: {integrator: idas, method: rodas5p, relative_tolerance: 1e-9, absolute_tolerance: 1e-10, "
                          "initial_step: 1e-5, maximum_step: 0.01, maximum_steps: 500, maximum_speed: 50, gradient: direct}"))
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
      read_text(with_line("optimizer: {algorithm: mma, max_evaluations: 7, relative_tolerance: 1e-3}")).optimizer;
  EXPECT_EQ(optimizer.algorithm, "mma");
  EXPECT_EQ(optimizer.max_evaluations, 7);
  EXPECT_EQ(optimizer.relative_tolerance, 1e-3);
}

TEST(StudyOptions, RefusesBadSolverValues) {
  expect_fault(with_line("solver: {integrator: euler}"), "solver.integrator", "unknown integrator", 3);
  expect_fault(with_line("solver: {method: rodas4p}"), "solver.method", "did you mean", 3);
  expect_fault(with_line("solver: {relative_tolerance: 0}"), "solver.relative_tolerance", "out of range", 3);
  expect_fault(with_line("solver: {absolute_tolerance: 1}"), "solver.absolute_tolerance", "out of range", 3);
  expect_fault(with_line("solver: {initial_step: -1}"), "solver.initial_step", "out of range", 3);
  expect_fault(with_line("solver: {maximum_step: -1}"), "solver.maximum_step", "out of range", 3);
  expect_fault(with_line("solver: {maximum_steps: 0}"), "solver.maximum_steps", "out of range", 3);
  expect_fault(with_line("solver: {maximum_steps: 2.5}"), "solver.maximum_steps", "not an integer", 3);
  expect_fault(with_line("solver: {maximum_speed: -1}"), "solver.maximum_speed", "out of range", 3);
  expect_fault(with_line("solver: {gradient: backward}"), "solver.gradient", "unknown gradient", 3);
  expect_fault(with_line("solver: {integrator: idas, gradient: adjoint}"), "solver.gradient", "integrator rosenbrock only", 3);
  expect_fault(with_line("solver: {sensitivity_tolerance: 1e-4, gradient: adjoint}"), "solver.gradient", "no sensitivities", 3);
  expect_fault(with_line("solver: {tolerance: 1e-6}"), "solver.tolerance", "unknown key", 3);
}

TEST(StudyOptions, ReadsTheLimits) {
  const LimitOptions none = read_text(kLeastStudy).limits;
  EXPECT_FALSE(none.effort || none.position);
  const LimitOptions limits =
      read_text(with_line("limits: {effort: true, position: true, stiffness: 2e3, dissipation: 0, width: 1e-2}")).limits;
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
  expect_fault(with_line("limits: {positions: true}"), "limits.positions", "unknown key", 3);
}

TEST(StudyOptions, RefusesBadOptimizerValues) {
  expect_fault(with_line("optimizer: {algorithm: slqsp}"), "optimizer.algorithm", "did you mean \"slsqp\"", 3);
  expect_fault(with_line("optimizer: {max_evaluations: 0}"), "optimizer.max_evaluations", "out of range", 3);
  expect_fault(with_line("optimizer: {relative_tolerance: -1e-6}"), "optimizer.relative_tolerance", "out of range", 3);
  expect_fault(with_line("optimizer: {max_iterations: 5}"), "optimizer.max_iterations", "unknown key", 3);
}

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
