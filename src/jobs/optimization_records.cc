// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/optimization_records.h"

#include <cmath>
#include <utility>

#include "jobs/ensemble_records.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/watched_records.h"

namespace codesign {

bool is_evaluated(const Problem& problem, const OptimizationResult& result) {
  return result.gradient.size() == static_cast<Eigen::Index>(problem.study().tuned.size());
}

bool has_objective(const Problem& problem, const OptimizationResult& result) {
  return is_evaluated(problem, result) || result.screened > result.unusable;
}

bool has_design(const Problem& problem, const OptimizationResult& result) {
  const auto size = static_cast<Eigen::Index>(problem.study().tuned.size());
  const bool is_complete = result.rho.size() == size && result.initial_rho.size() == size;
  return is_complete && (is_evaluated(problem, result) || result.status.is_interrupted());
}

namespace {

/// The margins of the constraints, by the text of the constraint.
Json margins_json(const Problem& problem, const OptimizationResult& result) {
  std::vector<std::string> constraints;
  for (const ParameterConstraint& constraint : problem.study().constraints) constraints.push_back(constraint.text);
  return by_name(constraints, result.margins);
}

/// The constraints among parameters, one object each; empty without any.
Json constraints_json(const Problem& problem, const OptimizationResult& result) {
  Json list = Json::array();
  for (const ParameterConstraint& constraint : problem.study().constraints) {
    const double margin = result.margins[static_cast<Eigen::Index>(list.size())];
    list.push_back({{"element", constraint.element},
                    {"constraint", constraint.text},
                    {"margin", margin},
                    {"violation", margin < 0.0 ? -margin : 0.0}});
  }
  return list;
}

/// How near the point is to an optimum, which bounds hold it, and where the optimum is not one point.
void add_optimality(const std::vector<std::string>& names, const OptimizationResult& result, Json* object) {
  (*object)["stationarity"] = result.stationarity;
  (*object)["slope"] = result.slope;
  (*object)["initial_slope"] = result.initial_slope;
  (*object)["bound_multipliers"] = by_name(names, result.bound_multipliers);
  Json directions = Json::array();
  for (Eigen::Index d = 0; d < result.flat_directions.cols(); ++d) directions.push_back(by_name(names, result.flat_directions.col(d)));
  (*object)["flat_directions"] = std::move(directions);
}

}  // namespace

Json optimization_json(const Problem& problem, const OptimizationResult& result) {
  const std::vector<std::string> names = problem.tuned_names();
  Json object;
  if (has_objective(problem, result)) object["objective"] = result.objective;
  if (is_evaluated(problem, result)) object["initial_objective"] = result.initial_objective;
  if (has_design(problem, result)) {
    object["parameters"] = parameters_json(problem, problem.parameters(result.rho));
    object["initial_parameters"] = parameters_json(problem, problem.parameters(result.initial_rho));
    object["gradient"] = by_name(names, result.gradient);
    object["initial_gradient"] = by_name(names, result.initial_gradient);
    object["margins"] = margins_json(problem, result);
    if (result.margins.size() > 0) object["constraints"] = constraints_json(problem, result);
  }
  object["iterations"] = result.iterations;
  object["evaluations"] = result.evaluations;
  object["failed_evaluations"] = result.failed_evaluations;
  object["termination"] = result.termination;
  if (!result.algorithm.empty()) object["algorithm"] = result.algorithm;
  if (std::isfinite(result.stationarity)) add_optimality(names, result, &object);
  add_statistics(result.statistics, &object);
  add_watched(result, &object);
  add_ensemble(problem, result, &object);
  if (has_design(problem, result)) add_counts(problem, problem.parameters(result.rho), &object);
  return object;
}

std::string optimization_report(const Problem& problem, const OptimizationResult& result, const Warnings& of_run) {
  Json object = optimization_json(problem, result);
  add_outcome(problem, of_run, result.status, &object);
  return to_text(object);
}

}  // namespace codesign
