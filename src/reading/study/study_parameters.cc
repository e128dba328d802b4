// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_blocks.h"

#include <unordered_map>

#include "description/expression.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "reading/study/study_values.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {
namespace {

/// A name that the model does not have is a new parameter only if the study gives `initial`;
/// otherwise it is most likely misspelt.
Parameter new_parameter(const std::string& name, const YamlValue& value,
                        const std::vector<Parameter>& model) {
  const std::string fault = identifier_fault(name);
  if (!fault.empty())
    throw InputError({value.where(), value.path(), fault, name,
                      "an identifier that is not the name of a function or constant"});
  if (value.find("initial"))
    return {name, 0.0, Parameter().lower, Parameter().upper, "", value.where()};
  const std::string hint = did_you_mean(nearest_name(name, names_of(model)));
  throw InputError({value.where(), value.path() + ".initial",
                    "required key is missing: the model has no such parameter" + hint, "",
                    "a parameter of the model, or a new one with initial: NUMBER"});
}

std::unordered_map<std::string, int> indices_of(const std::vector<Parameter>& parameters) {
  std::unordered_map<std::string, int> indices;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    indices.emplace(parameters[i].name, static_cast<int>(i));
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
    at.fail("the lower bound must lie below the upper bound",
            "lower < upper, not " + range_of(*parameter));
  }
  if (parameter->value < parameter->lower || parameter->value > parameter->upper)
    value.find("initial").value_or(value).fail("the start lies outside the bounds",
                                               range_of(*parameter));
}

void read_parameters(const YamlValue& study_value, const RobotDescription& robot,
                     const FileLoader& files, Study* study) {
  study->parameters = robot.parameters;
  const auto parameters = study_value.find("parameters");
  if (!parameters) return;
  std::unordered_map<std::string, int> indices = indices_of(study->parameters);
  for (const auto& [name, value] : parameters->entries()) {
    if (is_catalogue(value)) {
      read_catalogue(name, value, files, study);
      continue;
    }
    value.require_keys({}, {"tune", "initial", "lower", "upper", "choice", "integer"});
    const auto [found, is_new] = indices.emplace(name, static_cast<int>(study->parameters.size()));
    const int index = found->second;
    if (is_new) study->parameters.push_back(new_parameter(name, value, robot.parameters));
    Parameter& parameter = study->parameters[to_index(index)];
    if (const auto initial = value.find("initial")) parameter.value = initial->number();
    const auto tune = value.find("tune");
    const bool is_tuned = !tune || tune->boolean();
    if (is_tuned && (value.find("choice") || value.find("integer"))) {
      read_choice(name, value, index, study);
      continue;
    }
    read_bounds(value, &parameter);
    if (is_tuned) study->tuned.push_back(index);
  }
}

void read_fitted(const YamlValue& value, double lower, FittedNumber* number) {
  number->where = value.where();
  if (!value.is_map()) {
    number->value = value.number();
    return;
  }
  value.require_keys({}, {"initial", "lower", "upper"});
  Parameter parameter;
  parameter.value = number->value;
  parameter.lower = lower;
  if (const auto initial = value.find("initial")) parameter.value = initial->number();
  read_bounds(value, &parameter);
  number->is_fitted = true;
  number->value = parameter.value;
  number->lower = parameter.lower;
  number->upper = parameter.upper;
}

namespace {

constexpr const char* kFormsOfConstraints =
    "\"expression >= expression\", {expression: \"${expression}\", between: [lower, upper]}, "
    "{peak: signal, at_most: bound}, {loop: controller, measure: name, at_least: bound} or "
    "{poles: name, at_most: bound}";

/// Whether both bounds are the same number, so that the expression has to have it.
bool is_one_number(const Between& bounds) {
  return bounds.lower && bounds.upper && bounds.lower->is_constant() &&
         bounds.upper->is_constant() && bounds.lower->nominal() == bounds.upper->nominal();
}

std::string text_of(const Quantity& quantity) {
  return quantity.is_constant() ? to_decimal(quantity.nominal()) : quantity.expression()->text();
}

/// @param table the study's parameters. It is a copy, not the table in the study, since reading a
/// constraint must not mark its parameters as used: a constraint moves nothing.
void read_bounded_expression(const YamlValue& item, const ParameterTable& table, Study* study) {
  item.require_keys({"expression"}, {"between", "at_least", "at_most"});
  const YamlValue at = item.at("expression");
  const Quantity expression = read_quantity(at, table);
  if (expression.is_constant() || expression.expression()->dependencies().empty())
    at.fail("no parameter appears in the constraint", "an \"${expression}\" of the parameters");
  const Between bounds = read_between(item, table);
  const bool is_equality = is_one_number(bounds);
  if (bounds.lower && bounds.upper && !is_equality &&
      !(bounds.lower->nominal() < bounds.upper->nominal()))
    item.fail("the lower bound, " + to_decimal(bounds.lower->nominal()) +
                  ", must be less than the upper one, " + to_decimal(bounds.upper->nominal()) +
                  ", at the parameters' start",
              "lower < upper, or twice the same number for an equality");
  const auto add = [&](const std::string& text, const std::string& less, const std::string& more) {
    study->constraints.push_back(
        make_constraint(text, less, more, table.names, item.where(), item.path()));
  };
  const std::string middle = expression.expression()->text();
  if (is_equality) {
    add(middle + " == " + text_of(*bounds.lower), text_of(*bounds.lower), middle);
    study->constraints.back().is_equality = true;
    return;
  }
  if (bounds.lower) add(middle + " >= " + text_of(*bounds.lower), text_of(*bounds.lower), middle);
  if (bounds.upper) add(middle + " <= " + text_of(*bounds.upper), middle, text_of(*bounds.upper));
}

}  // namespace

const char* bounded_measure(const YamlValue& item) {
  if (!item.is_map()) return nullptr;
  if (item.find("peak")) return "peak";
  for (const char* measure : kMeasureNames)
    if (item.find(measure)) return measure;
  return nullptr;
}

void read_constraints(const YamlValue& study_value, Study* study) {
  const auto constraints = study_value.find("constraints");
  if (!constraints) return;
  const ParameterTable table(study->parameters);
  for (const YamlValue& item : constraints->items()) {
    if (bounded_measure(item) || is_linear_item(item)) continue;
    if (item.is_list() || (item.is_map() && !item.find("expression")))
      item.fail("not a constraint", kFormsOfConstraints);
    if (item.is_map())
      read_bounded_expression(item, table, study);
    else
      study->constraints.push_back(
          parse_constraint(item.text(), table.names, item.where(), item.path()));
  }
}

}  // namespace codesign
