// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/optimization_records.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "description/study.h"
#include "ensemble/scenario.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/record_cells.h"
#include "jobs/record_json.h"
#include "jobs/result_fields.h"
#include "jobs/shown_signals.h"
#include "math/arrays.h"
#include "optimization/result_report.h"
#include "problem/load_problem.h"
#include "text/number_text.h"

namespace codesign {
namespace {

Json to_json(const ScenarioResult& scenario) {
  Json object = record_json(scenario), values = Json::object();
  for (const auto& [name, value] : scenario.values) values[name] = value;
  object["values"] = std::move(values);
  return object;
}

Json to_json(const Validation& validation, bool has_value_at_risk) {
  Json object = record_json(validation);
  if (!has_value_at_risk)
    for (const char* name : {"value_at_risk", "within"}) object.erase(name);
  return object;
}

Json multistart_json(const Problem& problem, const OptimizationResult& result) {
  Json optima = Json::array();
  for (const Optimum& optimum : result.multistart.optima) {
    optima.push_back(record_json(optimum));
    optima.back()["parameters"] = by_name(problem.tuned_names(), optimum.rho);
  }
  Json object = record_json(result.multistart);
  object["optima"] = std::move(optima);
  return object;
}

/// Names of the parameters that any scenario sets, in the order of their first appearance.
std::vector<std::string> set_parameters(const OptimizationResult& result) {
  std::vector<std::string> names;
  for (const ScenarioResult& scenario : result.ensemble.scenarios)
    for (const auto& [name, value] : scenario.values)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

bool is_law_uncertain(const OptimizationResult& result) {
  return !result.ensemble.scenarios.empty() &&
         !result.ensemble.scenarios.front().friction_law.empty();
}

std::vector<std::string>::const_iterator law_column(const std::vector<std::string>& columns) {
  return std::find(columns.begin(), columns.end(), "friction_law");
}

void append(const std::vector<std::string>& more, std::vector<std::string>* texts) {
  texts->insert(texts->end(), more.begin(), more.end());
}

/// The margins of the constraints, by the text of the constraint.
Json margins_json(const Problem& problem, const OptimizationResult& result) {
  std::vector<std::string> constraints;
  for (const ParameterConstraint& constraint : study_of(problem).constraints)
    constraints.push_back(constraint.text);
  return by_name(constraints, result.constraints.margins);
}

/// The constraints among parameters, one object each; empty without any.
Json constraints_json(const Problem& problem, const OptimizationResult& result) {
  Json list = Json::array();
  for (const ParameterConstraint& constraint : study_of(problem).constraints) {
    const double margin = result.constraints.margins[to_signed(list.size())];
    list.push_back({{"element", constraint.element},
                    {"constraint", constraint.text},
                    {"margin", margin},
                    {"violation", margin < 0.0 ? -margin : 0.0}});
  }
  return list;
}

Json choice_json(const ChoiceResult& choice) {
  Json chosen = Json::object();
  for (const auto& [list, row] : choice.chosen) chosen[list] = row;
  Json object = {{"chosen", std::move(chosen)}};
  add_fields(choice, &object);
  return object;
}

/// How near the point is to an optimum, which bounds hold it, and where the optimum is not one
/// point.
void add_optimality(const std::vector<std::string>& names, const OptimizationResult& result,
                    Json* object) {
  (*object)["stationarity"] = result.optimality.stationarity;
  (*object)["slope"] = result.best.slope;
  (*object)["initial_slope"] = result.initial.slope;
  (*object)["bound_multipliers"] = by_name(names, result.optimality.bound_multipliers);
  Json directions = Json::array();
  for (Eigen::Index d = 0; d < result.optimality.flat_directions.cols(); ++d)
    directions.push_back(by_name(names, result.optimality.flat_directions.col(d)));
  (*object)["flat_directions"] = std::move(directions);
  if (result.optimality.independent.evaluations > 0)
    (*object)["differences"] = differences_json(result.optimality.independent);
}

}  // namespace

Json optimization_json(const Problem& problem, const OptimizationResult& result) {
  const std::vector<std::string> names = problem.tuned_names();
  Json object;
  if (has_objective(problem, result)) object["objective"] = result.best.objective;
  if (is_evaluated(problem, result)) object["initial_objective"] = result.initial.objective;
  if (has_design(problem, result)) {
    object["parameters"] = parameters_json(problem, problem.parameters(result.best.rho));
    object["initial_parameters"] = parameters_json(problem, problem.parameters(result.initial.rho));
    object["gradient"] = by_name(names, result.best.gradient);
    object["initial_gradient"] = by_name(names, result.initial.gradient);
    object["margins"] = margins_json(problem, result);
    if (result.constraints.margins.size() > 0)
      object["constraints"] = constraints_json(problem, result);
  }
  add_fields(result.cost, &object);
  object["termination"] = result.termination;
  if (result.choice.combinations > 0.0) object["choice"] = choice_json(result.choice);
  if (!result.algorithm.empty()) object["algorithm"] = result.algorithm;
  if (std::isfinite(result.optimality.stationarity)) add_optimality(names, result, &object);
  add_statistics(result.cost.statistics, &object);
  add_events(result.best.events, &object);
  add_watched(result, &object);
  add_ensemble(problem, result, &object);
  if (has_design(problem, result))
    add_counts(problem, problem.parameters(result.best.rho), &object);
  return object;
}

std::string optimization_report(const Problem& problem, const OptimizationResult& result,
                                const Warnings& of_run) {
  Json object = optimization_json(problem, result);
  add_outcome(problem, of_run, result.status, &object);
  return to_text(object);
}

void add_ensemble(const Problem& problem, const OptimizationResult& result, Json* object) {
  if (!result.ensemble.scenarios.empty()) {
    Json scenarios = Json::array();
    for (const ScenarioResult& scenario : result.ensemble.scenarios)
      scenarios.push_back(to_json(scenario));
    (*object)["scenarios"] = std::move(scenarios);
    (*object)["failed_scenarios"] = result.best.failed.size();
    if (const int worst = worst_scenario(result); worst >= 0)
      (*object)["worst_scenario"] = to_json(result.ensemble.scenarios[to_index(worst)]);
  }
  if (result.ensemble.value_at_risk) (*object)["value_at_risk"] = *result.ensemble.value_at_risk;
  if (result.ensemble.validation)
    (*object)["validation"] =
        to_json(*result.ensemble.validation, result.ensemble.value_at_risk.has_value());
  if (!result.multistart.starts.empty()) (*object)["multistart"] = multistart_json(problem, result);
}

std::vector<std::string> start_columns(const Problem& problem) {
  std::vector<std::string> columns = {"search"};
  append(columns_of<StartResult>(), &columns);
  for (const std::string& name : problem.tuned_names()) columns.push_back("start_" + name);
  append(problem.tuned_names(), &columns);
  return columns;
}

std::vector<std::vector<std::string>> start_rows(const OptimizationResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const StartResult& start : result.multistart.starts) {
    rows.push_back({std::to_string(rows.size() + 1)});
    append(cells_of(start), &rows.back());
    for (double value : start.start) rows.back().push_back(to_decimal(value));
    for (double value : start.rho) rows.back().push_back(to_decimal(value));
  }
  return rows;
}

std::vector<std::string> scenario_columns(const OptimizationResult& result) {
  std::vector<std::string> columns = columns_of<ScenarioResult>();
  if (!is_law_uncertain(result)) columns.erase(law_column(columns));
  append(set_parameters(result), &columns);
  return columns;
}

std::vector<std::vector<std::string>> scenario_rows(const OptimizationResult& result) {
  const std::vector<std::string> names = set_parameters(result),
                                 columns = columns_of<ScenarioResult>();
  std::vector<std::vector<std::string>> rows;
  for (const ScenarioResult& scenario : result.ensemble.scenarios) {
    std::vector<std::string>& row = rows.emplace_back(cells_of(scenario));
    if (!is_law_uncertain(result)) row.erase(row.begin() + (law_column(columns) - columns.begin()));
    for (const std::string& name : names) {
      std::string cell;
      for (const auto& [set, value] : scenario.values)
        if (set == name) cell = to_decimal(value);
      row.push_back(cell);
    }
  }
  return rows;
}

}  // namespace codesign
