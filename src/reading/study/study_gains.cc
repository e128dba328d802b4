// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "math/arrays.h"
#include "reading/study/study_blocks.h"
#include "reading/study/study_values.h"
#include "text/number_text.h"

namespace codesign {
namespace {

bool asks_for_gains(const YamlValue& controller) {
  if (!controller.is_map()) return false;
  const auto type = controller.find("type");
  return type && type->is_scalar() && type->text() == "state_feedback" && controller.find("gains");
}

/// One weight per signal, not negative; `effort` is positive.
void read_weights(const YamlValue& gains, std::size_t signals, InitialGains* result) {
  gains.require_keys({"from", "weights"}, {"effort", "lower", "upper", "tune"});
  const YamlValue weights = gains.at("weights");
  for (const YamlValue& weight : weights.items()) {
    result->weights.push_back(weight.number());
    if (!(result->weights.back() >= 0.0)) weight.fail("a weight is negative", "0 or more");
  }
  if (result->weights.size() != signals)
    weights.fail("found " + std::to_string(result->weights.size()) + " weights for " +
                     std::to_string(signals) + " signals",
                 "one per signal of feedback");
  if (const auto effort = gains.find("effort")) result->effort = read_above_zero(*effort);
}

/// Each pole a number, or [real, imaginary] for a pair of conjugates.
void read_poles(const YamlValue& gains, InitialGains* result) {
  gains.require_keys({"from", "poles"}, {"lower", "upper", "tune"});
  const auto add = [result](double real, double imaginary) {
    result->real.push_back(real);
    result->imaginary.push_back(imaginary);
  };
  for (const YamlValue& pole : gains.at("poles").items()) {
    if (!pole.is_list()) {
      add(pole.number(), 0.0);
      continue;
    }
    const std::vector<YamlValue> parts = pole.items();
    if (parts.size() != 2)
      pole.fail("a pair of poles has two numbers", "[real part, imaginary part] in 1/s");
    for (const double sign : {1.0, -1.0}) add(parts[0].number(), sign * parts[1].number());
  }
}

void declare_gains_of(const std::string& name, std::size_t index, const YamlValue& controller,
                      Study* study) {
  const YamlValue gains = controller.at("gains");
  const std::size_t signals = controller.at("feedback").items().size();
  InitialGains result;
  result.controller = index;
  result.where = gains.where();
  if (gains.at("from").choice("start of gains", {"lqr", "poles"}) == "lqr")
    read_weights(gains, signals, &result);
  else
    read_poles(gains, &result);
  const auto lower = gains.find("lower"), upper = gains.find("upper");
  const double least = lower ? lower->number() : 0.0, most = upper ? upper->number() : 0.0;
  const double start = least > 0.0 ? least : upper && most < 0.0 ? most : 0.0;
  const auto first = static_cast<int>(study->parameters.size());
  declare_numbers(gains, name + "_k", std::vector<double>(signals, start), study);
  for (int k = 0; k < static_cast<int>(signals); ++k) result.parameters.push_back(first + k);
  study->initial_gains.push_back(std::move(result));
}

}  // namespace

void declare_gains(const YamlValue& study_value, Study* study) {
  const auto controllers = study_value.find("controllers");
  if (!controllers || !controllers->is_map()) return;
  std::size_t index = 0;
  for (const auto& [name, value] : controllers->entries()) {
    if (asks_for_gains(value)) declare_gains_of(name, index, value, study);
    ++index;
  }
}

std::optional<Quantity> initial_gain(const std::string& controller, std::size_t k,
                                     const ParameterTable& table, const Study& study) {
  const std::string name = controller + "_k" + std::to_string(k);
  for (const InitialGains& gains : study.initial_gains)
    if (gains.controller == study.controllers.size())
      return Quantity(table.values[to_index(gains.parameters[k])], table.parse(name));
  return std::nullopt;
}

}  // namespace codesign
