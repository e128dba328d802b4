// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_options.h"

#include "reading/study/study_fields.h"
#include "text/number_text.h"

namespace codesign {
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

}  // namespace codesign
