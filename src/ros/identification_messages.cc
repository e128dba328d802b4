// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "ros/identification_messages.h"

#include <cstdint>
#include <limits>

#include "problem/load_problem.h"
#include "ros/job.h"

namespace codesign {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

mechanism_codesign::IdentifiedNumber to_message(const IdentifiedNumber& number) {
  mechanism_codesign::IdentifiedNumber message;
  message.name = number.name;
  message.unit = number.unit;
  message.start = number.start;
  message.value = number.value;
  message.lower = number.lower;
  message.upper = number.upper;
  message.determined = number.is_determined;
  message.on_bound = number.is_on_bound;
  message.deviation = number.is_on_bound ? kNotKnown : number.deviation;
  message.low = number.is_on_bound ? kNotKnown : number.low;
  message.high = number.is_on_bound ? kNotKnown : number.high;
  const auto end = [&](ProfileEnd found, double value) { return found == ProfileEnd::kFailed ? kNotKnown : value; };
  message.profile_low = number.profile ? end(number.profile->lower_end, number.profile->lower) : kNotKnown;
  message.profile_high = number.profile ? end(number.profile->upper_end, number.profile->upper) : kNotKnown;
  return message;
}

std::vector<mechanism_codesign::OutputFit> to_messages(const std::vector<OutputFit>& fits) {
  std::vector<mechanism_codesign::OutputFit> messages;
  for (const OutputFit& fit : fits) {
    mechanism_codesign::OutputFit& message = messages.emplace_back();
    message.joint = fit.joint;
    message.recorded_rms = fit.recorded;
    message.start_rms = fit.start;
    message.rms = fit.rms;
    message.worst = fit.worst;
    message.first_correlation = fit.whiteness.first_correlation;
    message.whiteness = fit.whiteness.probability;
  }
  return messages;
}

}  // namespace

mechanism_codesign::IdentifyResult identification_message(const Problem& problem, const IdentificationResult& result) {
  mechanism_codesign::IdentifyResult message;
  set_status(result.status, &message);
  message.message = result.status.cause;  // a fit has no time of its own
  const IntervalOptions& intervals = problem.study().identification->intervals;
  message.level = intervals.level;
  message.noise = kNoiseNames[static_cast<std::size_t>(intervals.noise)];
  for (const IdentifiedNumber& number : result.numbers) message.numbers.push_back(to_message(number));
  for (Eigen::Index row = 0; row < result.covariance.rows(); ++row)
    for (Eigen::Index column = 0; column < result.covariance.cols(); ++column) message.covariance.push_back(result.covariance(row, column));
  message.rank = static_cast<std::uint32_t>(result.rank);
  message.undetermined = result.undetermined;
  message.samples = static_cast<std::uint64_t>(result.samples);
  message.data = to_messages(result.data);
  message.holdout_samples = static_cast<std::uint64_t>(result.holdout_samples);
  message.holdout = to_messages(result.holdout);
  if (!result.parameters.empty())
    for (const Parameter& parameter : problem.all_parameters()) message.parameters.push_back(parameter.name);
  message.values = result.parameters;
  message.termination = result.termination;
  message.iterations = static_cast<std::uint32_t>(result.iterations);
  message.evaluations = static_cast<std::uint32_t>(result.evaluations);
  message.failed_evaluations = static_cast<std::uint32_t>(result.failed_evaluations);
  message.cpu_seconds = result.cpu_seconds;
  message.setup_seconds = problem.setup_seconds();
  return message;
}

}  // namespace codesign
