// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/jobs/messages.h"

#include <cstdint>
#include <limits>

#include "description/study.h"
#include "jobs/optimization_records.h"
#include "jobs/result_fields.h"
#include "math/arrays.h"
#include "optimization/result_report.h"
#include "problem/load_problem.h"
#include "ros/bags/job_bag.h"
#include "ros/common/message_fields.h"
#include "ros/common/replies.h"

namespace codesign {
namespace {

std::uint32_t count(int number) { return static_cast<std::uint32_t>(number); }

mechanism_codesign::ScenarioResult to_message(const ScenarioResult& scenario) {
  mechanism_codesign::ScenarioResult message;
  set_fields(scenario, &message);
  for (const auto& [name, value] : scenario.values) {
    message.parameters.push_back(name);
    message.values.push_back(value);
  }
  return message;
}

mechanism_codesign::Validation to_message(const Validation& validation) {
  mechanism_codesign::Validation message;
  set_fields(validation, &message);
  return message;
}

mechanism_codesign::SearchResult to_message(const StartResult& search) {
  mechanism_codesign::SearchResult message;
  set_fields(search, &message);
  message.start = to_array(search.start);
  message.end = to_array(search.rho);
  message.code = name_of(search.status.code);
  if (!search.status.ok()) message.message = reason(search.status);
  return message;
}

mechanism_codesign::Optimum to_message(const Optimum& optimum) {
  mechanism_codesign::Optimum message;
  set_fields(optimum, &message);
  message.values = to_array(optimum.rho);
  return message;
}

mechanism_codesign::WatchedSignal to_message(const WatchedResult& result, bool is_ensemble) {
  mechanism_codesign::WatchedSignal message;
  set_fields(result, &message);
  message.smallest_scenario =
      is_ensemble ? static_cast<std::uint32_t>(result.smallest_scenario) + 1 : 0;
  message.largest_scenario =
      is_ensemble ? static_cast<std::uint32_t>(result.largest_scenario) + 1 : 0;
  return message;
}

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

mechanism_codesign::IdentifiedNumber to_message(const IdentifiedNumber& number) {
  mechanism_codesign::IdentifiedNumber message;
  set_fields(number, &message);
  message.name = number.name;
  message.lower = number.lower;
  message.upper = number.upper;
  message.low = number.is_on_bound ? kNotKnown : number.low;
  message.high = number.is_on_bound ? kNotKnown : number.high;
  const auto end = [&](ProfileEnd found, double value) {
    return found == ProfileEnd::kFailed ? kNotKnown : value;
  };
  message.profile_low =
      number.profile ? end(number.profile->lower_end, number.profile->lower) : kNotKnown;
  message.profile_high =
      number.profile ? end(number.profile->upper_end, number.profile->upper) : kNotKnown;
  return message;
}

std::vector<mechanism_codesign::OutputFit> to_messages(const std::vector<OutputFit>& fits) {
  std::vector<mechanism_codesign::OutputFit> messages;
  for (const OutputFit& fit : fits) {
    mechanism_codesign::OutputFit& message = messages.emplace_back();
    set_fields(fit, &message);
    set_fields(fit.whiteness, &message);
    message.joint = fit.joint;
    message.whiteness = fit.whiteness.probability;
  }
  return messages;
}

}  // namespace

std::vector<mechanism_codesign::Warning> warning_messages(const Warnings& of_files,
                                                          const Warnings& of_job) {
  Warnings warnings = of_files;
  append(of_job, &warnings);
  std::vector<mechanism_codesign::Warning> messages;
  for (const Warning& warning : warnings) {
    set_fields(warning, &messages.emplace_back());
  }
  return messages;
}

Warnings warnings_of_job(const std::vector<mechanism_codesign::Warning>& messages,
                         std::size_t of_files) {
  Warnings warnings;
  for (std::size_t k = of_files; k < messages.size(); ++k)
    warnings.push_back({messages[k].code, messages[k].message, {}});
  return warnings;
}

mechanism_codesign::OptimizeResult optimization_message(const Problem& problem,
                                                        const OptimizationResult& result) {
  mechanism_codesign::OptimizeResult message;
  set_status(result.status, &message);
  message.parameters = problem.tuned_names();
  for (const ParameterConstraint& constraint : study_of(problem).constraints)
    message.constraints.push_back(constraint.text);
  message.margins = to_array(result.constraints.margins);
  message.initial = to_array(result.initial.rho);
  message.tuned = to_array(result.best.rho);
  message.initial_objective = result.initial.objective;
  message.objective = result.best.objective;
  message.initial_gradient = to_array(result.initial.gradient);
  message.gradient = to_array(result.best.gradient);
  message.termination = result.termination;
  set_fields(result.cost, &message);
  set_fields(result.cost.statistics, &message);
  set_ensemble(result, &message);
  message.signals =
      watched_messages(result.constraints.watched, !result.ensemble.scenarios.empty());
  return message;
}

void set_ensemble(const OptimizationResult& result, mechanism_codesign::OptimizeResult* message) {
  for (const ScenarioResult& scenario : result.ensemble.scenarios)
    message->scenarios.push_back(to_message(scenario));
  message->worst = count(worst_scenario(result) + 1);
  message->value_at_risk = result.ensemble.value_at_risk.value_or(0.0);
  if (result.ensemble.validation)
    message->validation.push_back(to_message(*result.ensemble.validation));
  for (const StartResult& search : result.multistart.starts)
    message->searches.push_back(to_message(search));
  for (const Optimum& optimum : result.multistart.optima)
    message->optima.push_back(to_message(optimum));
  message->screened = count(result.multistart.screened);
  message->unusable = count(result.multistart.unusable);
}

std::vector<mechanism_codesign::WatchedSignal> watched_messages(
    const std::vector<WatchedResult>& watched, bool is_ensemble) {
  std::vector<mechanism_codesign::WatchedSignal> messages;
  messages.reserve(watched.size());
  for (const WatchedResult& one : watched) messages.push_back(to_message(one, is_ensemble));
  return messages;
}

mechanism_codesign::IdentifyResult identification_message(const Problem& problem,
                                                          const IdentificationResult& result) {
  mechanism_codesign::IdentifyResult message;
  set_status(result.status, &message);
  message.message = result.status.cause;  // a fit has no time of its own
  const IntervalOptions& intervals = study_of(problem).identification->intervals;
  message.level = intervals.level;
  message.noise = kNoiseNames[to_index(intervals.noise)];
  for (const IdentifiedNumber& number : result.numbers)
    message.numbers.push_back(to_message(number));
  for (Eigen::Index row = 0; row < result.covariance.rows(); ++row)
    for (Eigen::Index column = 0; column < result.covariance.cols(); ++column)
      message.covariance.push_back(result.covariance(row, column));
  message.rank = static_cast<std::uint32_t>(result.rank);
  message.undetermined = result.undetermined;
  message.samples = static_cast<std::uint64_t>(result.samples);
  message.data = to_messages(result.data);
  message.holdout_samples = static_cast<std::uint64_t>(result.holdout_samples);
  message.holdout = to_messages(result.holdout);
  if (!result.parameters.empty())
    for (const Parameter& parameter : problem.all_parameters())
      message.parameters.push_back(parameter.name);
  message.values = result.parameters;
  set_fields(result, &message);
  message.setup_seconds = problem.setup_seconds();
  return message;
}

}  // namespace codesign
