// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_options.h"

#include <cmath>
#include <limits>
#include <optional>

#include "description/tuned_parameters.h"
#include "text/decimal.h"

namespace codesign {

void read_whole(const YamlValue& parent, const std::string& key, int least, int most, int* count) {
  const auto value = parent.find(key);
  if (!value) return;
  const std::string allowed = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const double number = value->number();
  if (number != std::floor(number)) value->fail("not an integer", allowed);
  if (number < least || number > most) value->fail(key + " out of range", allowed);
  *count = static_cast<int>(number);
}

void read_sampler(const YamlValue& parent, SamplerKind* sampler, std::uint32_t* seed) {
  read_choice(parent, "sampler", kSamplerNames, sampler);
  int number = static_cast<int>(*seed);
  read_whole(parent, "seed", 0, std::numeric_limits<int>::max(), &number);
  *seed = static_cast<std::uint32_t>(number);
}

namespace {

// Smallest tolerances that double precision (rounding 1.1e-16) can meet: a relative error test needs some hundred roundings, an absolute
// one the rounding of a position of 1 m, the objective a few roundings of its own.
constexpr double kLeastRelative = 1e-13, kLeastAbsolute = 1e-16, kLeastOfObjective = 1e-15;

void read_tolerance(const YamlValue& parent, const std::string& key, double least, double* tolerance) {
  const auto value = parent.find(key);
  if (!value) return;
  *tolerance = value->number();
  if (*tolerance < least || *tolerance >= 1.0) value->fail("tolerance out of range", "from " + to_decimal(least) + " to less than 1");
}

void read_positive_or_zero(const YamlValue& parent, const std::string& key, const char* allowed, double* number) {
  const auto value = parent.find(key);
  if (!value) return;
  *number = value->number();
  if (*number < 0.0) value->fail("number out of range", allowed);
}

void read_step(const YamlValue& parent, const std::string& key, double* step) {
  read_positive_or_zero(parent, key, "a positive number of seconds, or 0 for none", step);
}

void read_count(const YamlValue& parent, const std::string& key, int* count) {
  const auto value = parent.find(key);
  if (!value) return;
  *count = value->integer();
  if (*count < 1) value->fail("count out of range", "1 or more");
}

void read_positive(const YamlValue& parent, const std::string& key, bool zero_allowed, double* number) {
  const auto value = parent.find(key);
  if (!value) return;
  *number = value->number();
  if (*number < 0.0 || (*number == 0.0 && !zero_allowed)) value->fail(key + " out of range", zero_allowed ? "0 or more" : "more than 0");
}

/// Reads `gradient:`. The adjoint exists for the steps of the Rosenbrock integrator only, and cannot take part in their error test.
void read_gradient(const YamlValue& solver, SolverOptions* options) {
  const auto value = solver.find("gradient");
  if (!value) return;
  read_choice(solver, "gradient", kGradientMethodNames, &options->gradient);
  if (options->gradient != GradientMethod::kAdjoint) return;
  if (options->integrator != IntegratorKind::kRosenbrock)
    value->fail("the adjoint exists for the integrator rosenbrock only", "auto or direct with idas");
  if (options->sensitivity_tolerance > 0.0)
    value->fail("the adjoint computes no sensitivities, which sensitivity_tolerance needs for the error test",
                "auto or direct with sensitivity_tolerance");
}

}  // namespace

LimitOptions read_limit_options(const YamlValue& limits) {
  limits.require_keys({}, {"effort", "position", "stiffness", "dissipation", "width"});
  LimitOptions options;
  if (const auto effort = limits.find("effort")) options.effort = effort->boolean();
  if (const auto position = limits.find("position")) options.position = position->boolean();
  read_positive(limits, "stiffness", false, &options.stiffness);
  read_positive(limits, "dissipation", true, &options.dissipation);
  read_positive(limits, "width", false, &options.width);
  return options;
}

SolverOptions read_solver_options(const YamlValue& solver) {
  solver.require_keys({}, {"integrator", "method", "gradient", "relative_tolerance", "absolute_tolerance", "sensitivity_tolerance",
                           "initial_step", "maximum_step", "maximum_steps", "maximum_speed", "closure_tolerance", "coordinates"});
  SolverOptions options;
  read_choice(solver, "integrator", kIntegratorNames, &options.integrator);
  read_choice(solver, "method", kRosenbrockMethodNames, &options.method);
  read_tolerance(solver, "relative_tolerance", kLeastRelative, &options.relative_tolerance);
  read_tolerance(solver, "absolute_tolerance", kLeastAbsolute, &options.absolute_tolerance);
  read_tolerance(solver, "sensitivity_tolerance", kLeastRelative, &options.sensitivity_tolerance);
  read_step(solver, "initial_step", &options.initial_step);
  read_step(solver, "maximum_step", &options.maximum_step);
  read_count(solver, "maximum_steps", &options.maximum_steps);
  read_positive_or_zero(solver, "maximum_speed", "a positive speed in m/s and rad/s, or 0: chosen", &options.maximum_speed);
  read_positive(solver, "closure_tolerance", true, &options.closure_tolerance);
  read_choice(solver, "coordinates", kCoordinatesNames, &options.coordinates);
  if (const auto coordinates = solver.find("coordinates")) options.coordinates_where = coordinates->where();
  read_gradient(solver, &options);
  return options;
}

OptimizerOptions read_optimizer_options(const YamlValue& optimizer) {
  optimizer.require_keys({}, {"algorithm", "max_evaluations", "relative_tolerance"});
  OptimizerOptions options;
  options.where = optimizer.where();
  if (const auto algorithm = optimizer.find("algorithm")) {
    options.where = algorithm->where();
    options.algorithm = algorithm->choice("algorithm", {"auto", "lbfgs", "var1", "var2", "tnewton", "mma", "ccsaq", "slsqp", "cobyla",
                                                        "bobyqa", "auglag_lbfgs", "levenberg_marquardt"});
  }
  read_count(optimizer, "max_evaluations", &options.max_evaluations);
  read_tolerance(optimizer, "relative_tolerance", kLeastOfObjective, &options.relative_tolerance);
  return options;
}

namespace {

constexpr int kMostSamples = 100000, kMostValidated = 1000000;

void read_level(const YamlValue& robust, RobustOptions* options) {
  const auto level = robust.find("level");
  if (!level) return;
  if (options->measure != RobustMeasure::kCvar) level->fail("level belongs to cvar", "measure: cvar");
  options->level = level->number();
  if (!(options->level > 0.0 && options->level < 1.0)) level->fail("level out of range", "more than 0 and less than 1");
}

void read_factor(const YamlValue& robust, RobustOptions* options) {
  const auto factor = robust.find("factor");
  if (!factor) return;
  if (options->measure != RobustMeasure::kMeanPlusDeviation)
    factor->fail("factor belongs to mean_plus_deviation", "measure: mean_plus_deviation");
  options->factor = factor->number();
  if (options->factor < 0.0) factor->fail("factor out of range", "0 or more");
}

/// Runs alone are not sampled.
void refuse_samples(const YamlValue& robust) {
  for (const char* key : {"samples", "sampler", "seed", "validate"})
    if (const auto value = robust.find(key))
      value->fail(std::string(key) + " has no meaning without uncertain: nothing is sampled", "with the block uncertain only");
}

}  // namespace

RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble) {
  robust.require_keys({}, {"measure", "level", "factor", "samples", "sampler", "seed", "validate", "failed"});
  if (!ensemble.is_ensemble())
    robust.fail("there is nothing to be robust against: the study has neither uncertain nor runs", "with the block uncertain or runs");
  RobustOptions options = default_robust(ensemble, robust.where());
  if (ensemble.uncertain.empty()) refuse_samples(robust);
  read_choice(robust, "measure", kRobustMeasureNames, &options.measure);
  read_level(robust, &options);
  read_factor(robust, &options);
  read_whole(robust, "samples", 1, kMostSamples, &options.samples);
  read_sampler(robust, &options.sampler, &options.seed);
  read_whole(robust, "validate", 0, kMostValidated, &options.validate);
  read_choice(robust, "failed", kFailedSamplesNames, &options.failed);
  return options;
}

RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where) {
  RobustOptions options;
  options.where = where;
  if (ensemble.uncertain.empty()) options.samples = 1;
  return options;
}

namespace {

constexpr int kMostStarts = 100000, kMostScreened = 10000000;

/// The parameter as the study names it; the coefficients of a `basis` controller are declared elsewhere.
void require_bounds(const YamlValue& study_value, const Parameter& parameter) {
  const std::optional<InputFault> fault = find_missing_bounds(parameter);
  if (!fault) return;
  const auto parameters = study_value.find("parameters");
  if (const auto value = parameters ? parameters->find(parameter.name) : std::nullopt) value->fail(fault->message, fault->allowed);
  throw InputError(*fault);
}

}  // namespace

MultistartOptions read_multistart(const YamlValue& study_value, const Study& study) {
  const YamlValue multistart = study_value.at("multistart");
  multistart.require_keys({"starts"}, {"sampler", "seed", "screen", "cluster"});
  if (study.tuned.empty()) multistart.fail("the study tunes nothing, so there is nothing to search for", "with tuned parameters only");
  MultistartOptions options;
  options.where = multistart.where();
  read_whole(multistart, "starts", 1, kMostStarts, &options.starts);
  read_sampler(multistart, &options.sampler, &options.seed);
  options.screen = 4 * options.starts;
  read_whole(multistart, "screen", options.starts, kMostScreened, &options.screen);
  if (const auto cluster = multistart.find("cluster")) {
    options.cluster = cluster->number();
    if (!(options.cluster > 0.0 && options.cluster < 1.0)) cluster->fail("cluster out of range", "more than 0 and less than 1");
  }
  for (int index : study.tuned) require_bounds(study_value, study.parameters[static_cast<std::size_t>(index)]);
  return options;
}

}  // namespace codesign
