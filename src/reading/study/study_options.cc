// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_options.h"

#include <cmath>
#include <limits>
#include <optional>

#include "description/tuned_parameters.h"
#include "text/decimal.h"

namespace codesign {

std::string OptionRange::in_words() const {
  const bool is_whole = is_bounded() && has_least && has_most;
  if (is_whole) return "a whole number from " + std::to_string(static_cast<int>(least)) + " to " + std::to_string(static_cast<int>(most));
  const std::string end = is_bounded() ? "less than " + to_decimal(most) : "";
  if (has_least) return end.empty() ? to_decimal(least) + " or more" : "from " + to_decimal(least) + " to " + end;
  return "more than " + to_decimal(least) + (end.empty() ? "" : " and " + end);
}

namespace {

[[noreturn]] void refuse(const YamlValue& value, const std::string& key, const OptionRange& range) {
  value.fail(range.fault != nullptr ? range.fault : key + " out of range", range.allowed != nullptr ? range.allowed : range.in_words());
}

/// The adjoint exists for the steps of the Rosenbrock integrator only, and cannot take part in their error test.
void check_gradient(const YamlValue& solver, const SolverOptions& options) {
  if (options.gradient != GradientMethod::kAdjoint) return;
  const YamlValue value = solver.at("gradient");
  if (options.integrator != IntegratorKind::kRosenbrock)
    value.fail("the adjoint exists for the integrator rosenbrock only", "auto or direct with idas");
  if (options.sensitivity_tolerance > 0.0)
    value.fail("the adjoint computes no sensitivities, which sensitivity_tolerance needs for the error test",
               "auto or direct with sensitivity_tolerance");
}

}  // namespace

void OptionReader::operator()(const std::string& key, bool& option) const {
  if (const auto value = block.find(key)) option = value->boolean();
}

void OptionReader::operator()(const std::string& key, const OptionRange& range, double& option) const {
  const auto value = block.find(key);
  if (!value) return;
  option = value->number();
  if (!range.holds(option)) refuse(*value, key, range);
}

void OptionReader::operator()(const std::string& key, const OptionRange& range, int& option) const {
  const auto value = block.find(key);
  if (!value) return;
  const double number = range.is_bounded() ? value->number() : value->integer();
  if (number != std::floor(number)) value->fail("not an integer", range.in_words());
  if (!range.holds(number)) refuse(*value, key, range);
  option = static_cast<int>(number);
}

void OptionReader::operator()(const std::string& key, const OptionRange& range, std::uint32_t& option) const {
  int number = static_cast<int>(option);
  (*this)(key, range, number);
  option = static_cast<std::uint32_t>(number);
}

SolverOptions read_solver_options(const YamlValue& solver) {
  SolverOptions options;
  read_options(solver, &options);
  if (const auto coordinates = solver.find("coordinates")) options.coordinates_where = coordinates->where();
  check_gradient(solver, options);
  return options;
}

OptimizerOptions read_optimizer_options(const YamlValue& optimizer) {
  OptimizerOptions options;
  read_options(optimizer, &options);
  options.where = optimizer.find("algorithm").value_or(optimizer).where();
  return options;
}

namespace {

void refuse_key(const YamlValue& robust, const char* key, const std::string& measure) {
  if (const auto value = robust.find(key)) value->fail(std::string(key) + " belongs to " + measure, "measure: " + measure);
}

/// Runs alone are not sampled.
void refuse_samples(const YamlValue& robust) {
  for (const char* key : {"samples", "sampler", "seed", "validate"})
    if (const auto value = robust.find(key))
      value->fail(std::string(key) + " has no meaning without uncertain: nothing is sampled", "with the block uncertain only");
}

}  // namespace

RobustOptions read_robust(const YamlValue& robust, const EnsembleDescription& ensemble) {
  require_option_keys(robust, RobustOptions());
  if (!ensemble.is_ensemble())
    robust.fail("there is nothing to be robust against: the study has neither uncertain nor runs", "with the block uncertain or runs");
  RobustOptions options = default_robust(ensemble, robust.where());
  if (ensemble.uncertain.empty()) refuse_samples(robust);
  const OptionReader reader{robust};
  reader("measure", kRobustMeasureNames, options.measure);
  if (options.measure != RobustMeasure::kCvar) refuse_key(robust, "level", "cvar");
  if (options.measure != RobustMeasure::kMeanPlusDeviation) refuse_key(robust, "factor", "mean_plus_deviation");
  visit_options(reader, &options);
  return options;
}

RobustOptions default_robust(const EnsembleDescription& ensemble, const SourceLocation& where) {
  RobustOptions options;
  options.where = where;
  if (ensemble.uncertain.empty()) options.samples = 1;
  return options;
}

namespace {

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
  require_option_keys(multistart, MultistartOptions(), {"starts"});
  if (study.tuned.empty()) multistart.fail("the study tunes nothing, so there is nothing to search for", "with tuned parameters only");
  MultistartOptions options;
  options.where = multistart.where();
  visit_options(OptionReader{multistart}, &options);
  if (!multistart.find("screen")) options.screen = 4 * options.starts;
  for (int index : study.tuned) require_bounds(study_value, study.parameters[static_cast<std::size_t>(index)]);
  return options;
}

}  // namespace codesign
