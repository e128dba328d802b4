// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "optimization/scenario_results.h"

#include <cmath>

#include "optimization/local_search.h"
#include "optimization/search_trials.h"
#include "sampling/measure.h"
#include "text/cancel.h"

namespace codesign {
namespace {

ScenarioResult describe(const Study& study, const Scenario& scenario, double initial, double final) {
  ScenarioResult result{scenario.run, scenario.sample, scenario.weight, {}, initial, final, scenario.friction_law};
  for (const auto& [index, value] : scenario.values)
    result.values.emplace_back(study.parameters[static_cast<std::size_t>(index)].name, value);
  return result;
}

/// The weight of the values up to `bound`; failed scenarios are not among the values and count as larger than `bound`.
double share_within(double bound, const std::vector<double>& values, const std::vector<double>& weights) {
  double share = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] <= bound) share += weights[k];
  return share;
}

/// Evaluates the design on fresh samples. Unlike in the search, a failed sample does not make the design fail; it is only counted.
/// @returns std::nullopt if the validation was interrupted, or if its measure overflows. @param failure receives the status of that.
std::optional<Validation> validate(const Problem& problem, const Ensemble& ensemble, const OptimizationResult& design,
                                   const std::atomic<bool>* cancel, ProgressMeter* meter, Status* failure) {
  const RobustOptions& options = ensemble.options();
  const std::vector<Scenario> scenarios = make_validation_scenarios(problem, options.validate);
  meter->begin(SearchStage::kValidating, 1, scenarios.size());
  const std::vector<Evaluation> members = ensemble.engine().evaluate(tasks_at(scenarios, design.rho, Derivatives::kNone), cancel);
  Validation validation;
  validation.samples = options.validate;
  validation.promised = design.objective;
  std::vector<double> values, weights;
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (members[k].status.is_interrupted()) {
      *failure = members[k].status;
      return std::nullopt;
    }
    if (!members[k].status.ok()) {
      ++validation.failed;
      continue;
    }
    values.push_back(members[k].objective);
    weights.push_back(scenarios[k].weight);
  }
  if (values.empty()) return validation;
  const Eigen::VectorXd psi = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  Eigen::VectorXd w = Eigen::Map<Eigen::VectorXd>(weights.data(), psi.size());
  w /= w.sum();
  const Measured measured = measure(options, psi, w);
  if (!std::isfinite(measured.value)) {
    *failure = {StatusCode::kNonFinite, problem.study().duration, "the measure over the fresh samples of robust.validate is not finite"};
    return std::nullopt;
  }
  validation.objective = measured.value;
  if (design.value_at_risk) {
    validation.value_at_risk = measured.threshold;
    validation.within = share_within(*design.value_at_risk, values, weights);
  }
  validation.mean = w.dot(psi);
  validation.worst = psi.maxCoeff();
  return validation;
}

}  // namespace

void describe_scenarios(const Problem& problem, const Ensemble& ensemble, const std::atomic<bool>* cancel, ProgressMeter* meter,
                        OptimizationResult* result) {
  const std::vector<Scenario>& scenarios = ensemble.scenarios();
  const bool known =
      result->values.size() == static_cast<Eigen::Index>(scenarios.size()) && result->initial_values.size() == result->values.size();
  if (!problem.study().ensemble.is_ensemble() || !known) return;
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    result->scenarios.push_back(describe(problem.study(), scenarios[k], result->initial_values[i], result->values[i]));
  }
  for (int k : result->initial_failed) result->scenarios[static_cast<std::size_t>(k)].initial_failed = true;
  for (int k : result->failed) result->scenarios[static_cast<std::size_t>(k)].failed = true;
  if (ensemble.options().measure == RobustMeasure::kCvar)
    result->value_at_risk = measure(ensemble.options(), result->values, ensemble.weights()).threshold;
  if (ensemble.options().validate == 0 || is_set(cancel)) return;
  Status failure;
  result->validation = validate(problem, ensemble, *result, cancel, meter, &failure);
  if (failure.ok()) return;
  result->status = with_best_kept(failure);
  result->termination = name_of(failure.code);
}

}  // namespace codesign
