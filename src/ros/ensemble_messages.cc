// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/ensemble_messages.h"

#include <cstdint>

#include "jobs/optimization_records.h"
#include "jobs/trial_lines.h"
#include "ros/conversions.h"

namespace codesign {
namespace {

std::uint32_t count(int number) { return static_cast<std::uint32_t>(number); }

mechanism_codesign::ScenarioResult to_message(const ScenarioResult& scenario) {
  mechanism_codesign::ScenarioResult message;
  message.run = scenario.run;
  message.sample = count(scenario.sample + 1);
  message.weight = scenario.weight;
  for (const auto& [name, value] : scenario.values) {
    message.parameters.push_back(name);
    message.values.push_back(value);
  }
  message.friction_law = scenario.friction_law;
  message.initial_objective = scenario.initial_objective;
  message.objective = scenario.objective;
  message.initial_failed = scenario.initial_failed;
  message.failed = scenario.failed;
  return message;
}

mechanism_codesign::Validation to_message(const Validation& validation) {
  mechanism_codesign::Validation message;
  message.samples = count(validation.samples);
  message.failed = count(validation.failed);
  message.promised = validation.promised;
  message.objective = validation.objective;
  message.mean = validation.mean;
  message.worst = validation.worst;
  message.value_at_risk = validation.value_at_risk;
  message.within = validation.within;
  return message;
}

mechanism_codesign::SearchResult to_message(const StartResult& search) {
  mechanism_codesign::SearchResult message;
  message.start = to_array(search.start);
  message.end = to_array(search.rho);
  message.start_objective = search.start_objective;
  message.objective = search.objective;
  message.code = name_of(search.status.code);
  if (!search.status.ok()) message.message = reason(search.status);
  message.termination = search.termination;
  message.evaluations = count(search.evaluations);
  message.optimum = count(search.optimum + 1);
  return message;
}

mechanism_codesign::Optimum to_message(const Optimum& optimum) {
  mechanism_codesign::Optimum message;
  message.values = to_array(optimum.rho);
  message.objective = optimum.objective;
  message.found = count(optimum.found);
  return message;
}

}  // namespace

void set_ensemble(const OptimizationResult& result, mechanism_codesign::OptimizeResult* message) {
  for (const ScenarioResult& scenario : result.scenarios) message->scenarios.push_back(to_message(scenario));
  message->worst = count(worst_scenario(result) + 1);
  message->value_at_risk = result.value_at_risk.value_or(0.0);
  if (result.validation) message->validation.push_back(to_message(*result.validation));
  for (const StartResult& search : result.starts) message->searches.push_back(to_message(search));
  for (const Optimum& optimum : result.optima) message->optima.push_back(to_message(optimum));
  message->screened = count(result.screened);
  message->unusable = count(result.unusable);
}

}  // namespace codesign
