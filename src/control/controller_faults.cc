// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
// Numbers of controllers that are impossible at a design.
#include <string>
#include <vector>

#include "control/controller.h"
#include "description/motion_study.h"
#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

// Names are put together for faults alone: a design without any asks for no memory.
std::string find_bad_bounds(const ControllerDescription& of, const char* key,
                            const Bounds<double>& bounds, bool is_smooth) {
  const auto name = [&of, key] { return "controllers." + of.name + "." + key; };
  const auto is_bad = [is_smooth](double bound) {
    return is_smooth ? !(bound > 0.0) : bound < 0.0;
  };
  const bool is_lower = is_bad(-bounds.lower) && !bounds.is_symmetric;
  if (is_bad(bounds.upper) || (bounds.is_symmetric && !(bounds.upper > 0.0)))
    return name() + " is " + to_decimal(bounds.upper) + ", it must be positive";
  if (is_lower)
    return "the lower bound of " + name() + " is " + to_decimal(bounds.lower) +
           (is_smooth ? ", it must be negative" : ", it must not be positive");
  if (!(bounds.lower < bounds.upper)) return name() + " leaves nothing between its bounds";
  return "";
}

/// A frequency from half of the sampling rate on has no bilinear transform that keeps it.
std::string find_bad_filter(const FilterDescription& filter, const std::string& name,
                            double sample_time, const std::vector<double>& numbers) {
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const FilterNumber& of = filter.kind->numbers[k];
    if (of.may_be_zero ? !(numbers[k] >= 0.0) : !(numbers[k] > 0.0))
      return name + "." + of.name + " is " + to_decimal(numbers[k]) +
             (of.may_be_zero ? ", it must not be negative" : ", it must be positive");
  }
  if (filter.kind->is_prewarped && sample_time * numbers.front() >= 0.5)
    return name + "." + filter.kind->numbers[0].name + " is " + to_decimal(numbers.front()) +
           " Hz, it must be below half of the sampling rate, " + to_decimal(0.5 / sample_time) +
           " Hz";
  return "";
}

}  // namespace

std::string find_impossible(const ControllerDescription& description,
                            const ControllerConstants<double>& constants) {
  const ControlRealization& realization = description.realization;
  const auto name = [&description] { return "controllers." + description.name + "."; };
  const bool is_smooth = !realization.is_sampled();
  std::string fault;
  if (realization.i_clamp)
    fault = find_bad_bounds(description, "i_clamp", constants.i_clamp, is_smooth);
  if (fault.empty() && realization.output_limit)
    fault = find_bad_bounds(description, "output_limit", constants.output_limit,
                            is_smooth && !realization.limit_has_corners);
  if (fault.empty() && realization.rate_limit)
    fault = find_bad_bounds(description, "rate_limit", constants.rate_limit, is_smooth);
  const struct {
    const char* name;
    bool exists;
    double value;
  } numbers[] = {
      {"derivative_filter", realization.derivative_filter.has_value(), constants.derivative_filter},
      {"time_constant", realization.time_constant.has_value(), constants.time_constant}};
  for (const auto& number : numbers)
    if (fault.empty() && number.exists && !(number.value > 0.0))
      fault = name() + number.name + " is " + to_decimal(number.value) + ", it must be positive";
  // With the opposite sign what is cut off would drive the integral on.
  if (fault.empty() && realization.antiwindup == AntiWindup::kBackCalculation &&
      constants.tracking * constants.pid.i < 0.0)
    fault = name() +
            (realization.tracking_time ? "tracking_time is " : "tracking_time, p / i, is ") +
            to_decimal(constants.tracking / constants.pid.i) + ", it must be positive";
  return fault;
}

std::string find_impossible_observer(const ControllerDescription& description,
                                     const std::vector<double>& parameters) {
  const ObserverDescription& observer = description.observer;
  const struct {
    const char* name;
    const Quantity* of;
  } numbers[] = {{"inertia", &observer.inertia},
                 {"bandwidth", observer.bandwidth ? &*observer.bandwidth : nullptr},
                 {"process", observer.process ? &*observer.process : nullptr},
                 {"measurement", observer.measurement ? &*observer.measurement : nullptr}};
  for (const auto& number : numbers)
    if (number.of && !(number.of->at(parameters) > 0.0))
      return "controllers." + description.name + "." + number.name + " is " +
             to_decimal(number.of->at(parameters)) + ", it must be positive";
  return "";
}

std::string find_impossible_filter(const ControllerDescription& description,
                                   const std::vector<double>& parameters) {
  for (std::size_t k = 0; k < filtered_inputs(description); ++k) {
    const std::vector<FilterDescription>& filters = filters_of(description, k);
    for (std::size_t stage = 0; stage < filters.size(); ++stage) {
      const FilterDescription& filter = filters[stage];
      std::vector<double> numbers;
      for (const Quantity& number : filter.numbers) numbers.push_back(number.at(parameters));
      const bool is_term = !description.kind->has_error();
      std::string name = "controllers." + description.name +
                         (is_term ? ".feedback[" + std::to_string(k) + "]" : "") + ".filter";
      if (filters.size() > 1) name += "[" + std::to_string(stage) + "]";
      if (std::string fault =
              find_bad_filter(filter, name, description.realization.sample_time, numbers);
          !fault.empty())
        return fault;
    }
  }
  return "";
}

}  // namespace codesign
