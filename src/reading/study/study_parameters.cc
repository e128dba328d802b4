// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_parameters.h"

#include <unordered_map>

#include "description/expression.h"
#include "description/tuned_parameters.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"

namespace codesign {
namespace {

/// A name that the model does not have is a new parameter only if the study gives `initial`; otherwise it is most likely misspelt.
Parameter new_parameter(const std::string& name, const YamlValue& value, const std::vector<Parameter>& model) {
  const std::string fault = identifier_fault(name);
  if (!fault.empty())
    throw InputError({value.where(), value.path(), fault, name, "an identifier that is not the name of a function or constant"});
  if (value.find("initial")) return {name, 0.0, Parameter().lower, Parameter().upper, "", value.where()};
  const std::string hint = did_you_mean(nearest_name(name, names_of(model)));
  throw InputError({value.where(), value.path() + ".initial", "required key is missing: the model has no such parameter" + hint, "", ""});
}

std::unordered_map<std::string, int> indices_of(const std::vector<Parameter>& parameters) {
  std::unordered_map<std::string, int> indices;
  for (std::size_t i = 0; i < parameters.size(); ++i) indices.emplace(parameters[i].name, static_cast<int>(i));
  return indices;
}

}  // namespace

void read_bounds(const YamlValue& value, Parameter* parameter) {
  const auto lower = value.find("lower");
  const auto upper = value.find("upper");
  if (lower) parameter->lower = lower->number();
  if (upper) parameter->upper = upper->number();
  if (!(parameter->lower < parameter->upper)) {
    const YamlValue& at = lower ? *lower : upper ? *upper : value;
    at.fail("the lower bound must lie below the upper bound", "lower < upper, not " + range_of(*parameter));
  }
  if (parameter->value < parameter->lower || parameter->value > parameter->upper)
    value.find("initial").value_or(value).fail("the start lies outside the bounds", range_of(*parameter));
}

void read_parameters(const YamlValue& study_value, const RobotDescription& robot, Study* study) {
  study->parameters = robot.parameters;
  const auto parameters = study_value.find("parameters");
  if (!parameters) return;
  std::unordered_map<std::string, int> indices = indices_of(study->parameters);
  for (const auto& [name, value] : parameters->entries()) {
    value.require_keys({}, {"tune", "initial", "lower", "upper"});
    const auto [found, is_new] = indices.emplace(name, static_cast<int>(study->parameters.size()));
    const int index = found->second;
    if (is_new) study->parameters.push_back(new_parameter(name, value, robot.parameters));
    Parameter& parameter = study->parameters[static_cast<std::size_t>(index)];
    if (const auto initial = value.find("initial")) parameter.value = initial->number();
    read_bounds(value, &parameter);
    const auto tune = value.find("tune");
    if (!tune || tune->boolean()) study->tuned.push_back(index);
  }
}

}  // namespace codesign
