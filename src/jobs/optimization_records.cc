// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "jobs/optimization_records.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ensemble/scenario.h"
#include "jobs/json.h"
#include "jobs/json_records.h"
#include "jobs/shown_signals.h"
#include "jobs/trial_lines.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

Json to_json(const ScenarioResult& scenario) {
  Json values = Json::object();
  for (const auto& [name, value] : scenario.values) values[name] = value;
  Json object = {{"run", scenario.run},
                 {"sample", scenario.sample + 1},
                 {"weight", scenario.weight},
                 {"values", values},
                 {"initial_objective", scenario.initial_objective},
                 {"objective", scenario.objective},
                 {"initial_failed", scenario.initial_failed},
                 {"failed", scenario.failed}};
  if (!scenario.friction_law.empty()) object["friction_law"] = scenario.friction_law;
  return object;
}

Json to_json(const Validation& validation, bool has_value_at_risk) {
  Json object = {{"samples", validation.samples},   {"failed", validation.failed},
                 {"promised", validation.promised}, {"objective", validation.objective},
                 {"mean", validation.mean},         {"worst", validation.worst}};
  if (!has_value_at_risk) return object;
  object["value_at_risk"] = validation.value_at_risk;
  object["within"] = validation.within;
  return object;
}

Json multistart_json(const Problem& problem, const OptimizationResult& result) {
  Json optima = Json::array();
  for (const Optimum& optimum : result.optima)
    optima.push_back({{"objective", optimum.objective},
                      {"found", optimum.found},
                      {"parameters", by_name(problem.tuned_names(), optimum.rho)}});
  return {{"starts", result.starts.size()},
          {"screened", result.screened},
          {"unusable", result.unusable},
          {"optima", optima}};
}

/// Names of the parameters that any scenario sets, in the order of their first appearance.
std::vector<std::string> set_parameters(const OptimizationResult& result) {
  std::vector<std::string> names;
  for (const ScenarioResult& scenario : result.scenarios)
    for (const auto& [name, value] : scenario.values)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

bool is_law_uncertain(const OptimizationResult& result) {
  return !result.scenarios.empty() && !result.scenarios.front().friction_law.empty();
}

int count_failed(const std::vector<StartResult>& starts) {
  return static_cast<int>(std::count_if(
      starts.begin(), starts.end(), [](const StartResult& start) { return start.optimum < 0; }));
}

/// "; the worst is run \"loaded\", sample 3, with 2.5", and how many failed.
std::string describe_worst(const OptimizationResult& result) {
  const int worst = worst_scenario(result);
  if (worst < 0) return "";
  const ScenarioResult& scenario = result.scenarios[to_index(worst)];
  const std::string name = scenario_name(scenario.run, scenario.sample),
                    law = scenario.friction_law;
  return "; the worst is " + (name.empty() ? "the nominal run" : name) +
         (law.empty() ? "" : " (" + law + ")") + ", with " + readable(scenario.objective) +
         (result.failed.empty() ? "" : "; " + std::to_string(result.failed.size()) + " failed");
}

/// A sentence about the value at risk and its validation on fresh samples.
std::string describe_risk(const RobustOptions& options, const OptimizationResult& result) {
  std::string text = "with a probability of " + readable(options.level) +
                     " the objective is at most " + readable(*result.value_at_risk) +
                     " on these samples";
  if (const auto& v = result.validation)
    text += ", and at most " + readable(v->value_at_risk) + " on fresh samples, of which " +
            readable(100.0 * v->within, 4) + " % do not exceed the first value";
  return text;
}

}  // namespace

bool is_evaluated(const Problem& problem, const OptimizationResult& result) {
  return result.gradient.size() == to_signed(problem.study().tuned.size());
}

bool has_objective(const Problem& problem, const OptimizationResult& result) {
  return is_evaluated(problem, result) || result.screened > result.unusable;
}

bool has_design(const Problem& problem, const OptimizationResult& result) {
  const auto size = to_signed(problem.study().tuned.size());
  const bool is_complete = result.rho.size() == size && result.initial_rho.size() == size;
  return is_complete && (is_evaluated(problem, result) || result.status.is_interrupted());
}

namespace {

/// The margins of the constraints, by the text of the constraint.
Json margins_json(const Problem& problem, const OptimizationResult& result) {
  std::vector<std::string> constraints;
  for (const ParameterConstraint& constraint : problem.study().constraints)
    constraints.push_back(constraint.text);
  return by_name(constraints, result.margins);
}

/// The constraints among parameters, one object each; empty without any.
Json constraints_json(const Problem& problem, const OptimizationResult& result) {
  Json list = Json::array();
  for (const ParameterConstraint& constraint : problem.study().constraints) {
    const double margin = result.margins[to_signed(list.size())];
    list.push_back({{"element", constraint.element},
                    {"constraint", constraint.text},
                    {"margin", margin},
                    {"violation", margin < 0.0 ? -margin : 0.0}});
  }
  return list;
}

/// How near the point is to an optimum, which bounds hold it, and where the optimum is not one
/// point.
void add_optimality(const std::vector<std::string>& names, const OptimizationResult& result,
                    Json* object) {
  (*object)["stationarity"] = result.stationarity;
  (*object)["slope"] = result.slope;
  (*object)["initial_slope"] = result.initial_slope;
  (*object)["bound_multipliers"] = by_name(names, result.bound_multipliers);
  Json directions = Json::array();
  for (Eigen::Index d = 0; d < result.flat_directions.cols(); ++d)
    directions.push_back(by_name(names, result.flat_directions.col(d)));
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

std::string optimization_report(const Problem& problem, const OptimizationResult& result,
                                const Warnings& of_run) {
  Json object = optimization_json(problem, result);
  add_outcome(problem, of_run, result.status, &object);
  return to_text(object);
}

int worst_scenario(const OptimizationResult& result) {
  int worst = -1;
  for (std::size_t k = 0; k < result.scenarios.size(); ++k) {
    if (result.scenarios[k].failed) continue;
    if (worst < 0 || result.scenarios[k].objective > result.scenarios[to_index(worst)].objective)
      worst = static_cast<int>(k);
  }
  return worst;
}

void add_ensemble(const Problem& problem, const OptimizationResult& result, Json* object) {
  if (!result.scenarios.empty()) {
    Json scenarios = Json::array();
    for (const ScenarioResult& scenario : result.scenarios) scenarios.push_back(to_json(scenario));
    (*object)["scenarios"] = std::move(scenarios);
    (*object)["failed_scenarios"] = result.failed.size();
    if (const int worst = worst_scenario(result); worst >= 0)
      (*object)["worst_scenario"] = to_json(result.scenarios[to_index(worst)]);
  }
  if (result.value_at_risk) (*object)["value_at_risk"] = *result.value_at_risk;
  if (result.validation)
    (*object)["validation"] = to_json(*result.validation, result.value_at_risk.has_value());
  if (!result.starts.empty()) (*object)["multistart"] = multistart_json(problem, result);
}

std::vector<std::string> ensemble_sentences(const Problem& problem,
                                            const OptimizationResult& result) {
  std::vector<std::string> lines;
  const EnsembleDescription& asked = problem.study().ensemble;
  if (!result.scenarios.empty()) {
    const RobustOptions options = asked.robust_options();
    lines.push_back(std::string("objective: ") + kRobustMeasureNames[to_index(options.measure)] +
                    " over " + std::to_string(result.scenarios.size()) + " scenarios" +
                    describe_worst(result));
  }
  if (result.value_at_risk) lines.push_back(describe_risk(asked.robust_options(), result));
  if (const auto& v = result.validation)
    lines.push_back("fresh samples: " + readable(v->objective) + " instead of " +
                    readable(v->promised) + ", mean " + readable(v->mean) + ", worst " +
                    readable(v->worst) + ", " + std::to_string(v->failed) + " failed");
  if (result.starts.empty()) return lines;
  lines.push_back(std::to_string(result.screened) + " points screened, " +
                  std::to_string(result.unusable) + " of them unusable; " +
                  std::to_string(result.starts.size()) + " searches, " +
                  std::to_string(count_failed(result.starts)) + " of them without an optimum");
  constexpr std::size_t kShown = 10;
  for (std::size_t k = 0; k < std::min(kShown, result.optima.size()); ++k)
    lines.push_back("optimum " + std::to_string(k + 1) + ": objective " +
                    readable(result.optima[k].objective) + ", found by " +
                    std::to_string(result.optima[k].found) + " searches");
  if (result.optima.size() > kShown)
    lines.push_back(std::to_string(result.optima.size() - kShown) + " further optima");
  return lines;
}

std::vector<std::string> start_columns(const Problem& problem) {
  std::vector<std::string> columns = {"search",      "start_objective", "objective", "status",
                                      "termination", "evaluations",     "optimum"};
  for (const std::string& name : problem.tuned_names()) columns.push_back("start_" + name);
  for (const std::string& name : problem.tuned_names()) columns.push_back(name);
  return columns;
}

std::vector<std::vector<std::string>> start_rows(const OptimizationResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const StartResult& start : result.starts) {
    rows.push_back({std::to_string(rows.size() + 1), to_decimal(start.start_objective),
                    to_decimal(start.objective), name_of(start.status.code), start.termination,
                    std::to_string(start.evaluations), std::to_string(start.optimum + 1)});
    for (double value : start.start) rows.back().push_back(to_decimal(value));
    for (double value : start.rho) rows.back().push_back(to_decimal(value));
  }
  return rows;
}

std::vector<std::string> scenario_columns(const OptimizationResult& result) {
  std::vector<std::string> columns = {"run",       "sample",         "weight", "initial_objective",
                                      "objective", "initial_failed", "failed"};
  if (is_law_uncertain(result)) columns.emplace_back("friction_law");
  for (const std::string& name : set_parameters(result)) columns.push_back(name);
  return columns;
}

std::vector<std::vector<std::string>> scenario_rows(const OptimizationResult& result) {
  const std::vector<std::string> names = set_parameters(result);
  std::vector<std::vector<std::string>> rows;
  for (const ScenarioResult& scenario : result.scenarios) {
    rows.push_back({scenario.run, std::to_string(scenario.sample + 1), to_decimal(scenario.weight),
                    to_decimal(scenario.initial_objective), to_decimal(scenario.objective),
                    scenario.initial_failed ? "1" : "0", scenario.failed ? "1" : "0"});
    if (is_law_uncertain(result)) rows.back().push_back(scenario.friction_law);
    for (const std::string& name : names) {
      std::string cell;
      for (const auto& [set, value] : scenario.values)
        if (set == name) cell = to_decimal(value);
      rows.back().push_back(cell);
    }
  }
  return rows;
}

}  // namespace codesign
