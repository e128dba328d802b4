// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/entry_keys.h"
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

/// A parameter of the study with what else is said of it there.
struct TunedParameter : Parameter {
  bool tune = true;
};

template <class Entry>
EntryKeys<Entry, NoContext> value_keys() {
  const auto number_key = [](const char* name, double Parameter::*member) {
    return optional_key<Entry, NoContext>(
        name, [member](const YamlValue& value, const NoContext&, Entry* entry) {
          entry->*member = value.number();
        });
  };
  return {number_key("initial", &Parameter::value), number_key("lower", &Parameter::lower),
          number_key("upper", &Parameter::upper)};
}

EntryKeys<TunedParameter, NoContext> parameter_keys() {
  using Keys = EntryKeys<TunedParameter, NoContext>;
  return with(value_keys<TunedParameter>(),
              Keys{optional_key<TunedParameter, NoContext>(
                       "tune", [](const YamlValue& value, const NoContext&,
                                  TunedParameter* entry) { entry->tune = value.boolean(); }),
                   optional_key<TunedParameter, NoContext>("choice"),
                   optional_key<TunedParameter, NoContext>("integer")});
}

void check_bounds(const YamlValue& value, const Parameter& parameter) {
  const auto lower = value.find("lower"), upper = value.find("upper");
  if (!(parameter.lower < parameter.upper)) {
    const YamlValue& at = lower ? *lower : upper ? *upper : value;
    at.fail("the lower bound must lie below the upper bound",
            "lower < upper, not " + range_of(parameter));
  }
  if (parameter.value < parameter.lower || parameter.value > parameter.upper)
    value.find("initial").value_or(value).fail("the start lies outside the bounds",
                                               range_of(parameter));
}

}  // namespace

std::vector<EntryForm> forms_of_parameters() { return {{"parameters.NAME", parameter_keys()}}; }

void read_bounds(const YamlValue& value, Parameter* parameter) {
  if (const auto lower = value.find("lower")) parameter->lower = lower->number();
  if (const auto upper = value.find("upper")) parameter->upper = upper->number();
  check_bounds(value, *parameter);
}

void read_parameters(const YamlValue& study_value, const RobotDescription& robot,
                     const FileLoader& files, Study* study) {
  study->parameters = robot.parameters;
  const auto parameters = study_value.find("parameters");
  if (!parameters) return;
  std::unordered_map<std::string, int> indices = indices_of(study->parameters);
  const EntryKeys<TunedParameter, NoContext> keys = parameter_keys();
  for (const auto& [name, value] : parameters->entries()) {
    if (is_catalogue(value)) {
      read_catalogue(name, value, files, study);
      continue;
    }
    require_keys(value, keys);
    const auto [found, is_new] = indices.emplace(name, static_cast<int>(study->parameters.size()));
    const int index = found->second;
    if (is_new) study->parameters.push_back(new_parameter(name, value, robot.parameters));
    TunedParameter entry{study->parameters[to_index(index)]};
    read_entry(value, keys, NoContext(), &entry);
    const bool is_chosen = entry.tune && (value.find("choice") || value.find("integer"));
    if (!is_chosen) check_bounds(value, entry);
    if (entry.tune && !is_chosen) study->tuned.push_back(index);
    study->parameters[to_index(index)] = std::move(entry);
    if (is_chosen) read_choice(name, value, index, study);
  }
}

void read_fitted(const YamlValue& value, double lower, FittedNumber* number) {
  number->where = value.where();
  if (!value.is_map()) {
    number->value = value.number();
    return;
  }
  Parameter parameter;
  parameter.value = number->value;
  parameter.lower = lower;
  read_entry(value, value_keys<Parameter>(), NoContext(), &parameter);
  check_bounds(value, parameter);
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

std::string text_of(const Quantity& quantity) {
  return quantity.is_constant() ? to_decimal(quantity.nominal()) : quantity.expression()->text();
}

/// An expression with its bounds, as written.
struct BoundedExpression {
  Quantity expression;
  std::optional<Quantity> lower, upper;
};

/// Whether both bounds are the same number, so that the expression has to have it.
bool is_one_number(const BoundedExpression& bounds) {
  return bounds.lower && bounds.upper && bounds.lower->is_constant() &&
         bounds.upper->is_constant() && bounds.lower->nominal() == bounds.upper->nominal();
}

EntryKeys<BoundedExpression> expression_keys() {
  return with(
      EntryKeys<BoundedExpression>{required_key<BoundedExpression>(
          "expression",
          [](const YamlValue& value, const EntryContext& in, BoundedExpression* of) {
            of->expression = read_quantity(value, in.table);
            if (of->expression.is_constant() || of->expression.expression()->dependencies().empty())
              value.fail("no parameter appears in the constraint",
                         "an \"${expression}\" of the parameters");
          })},
      bound_keys<BoundedExpression>());
}

void read_bounded_expression(const YamlValue& item, const EntryContext& in, Study* study) {
  BoundedExpression bounded;
  read_entry(item, expression_keys(), in, &bounded);
  require_bounds(item);
  const bool is_equality = is_one_number(bounded);
  if (bounded.lower && bounded.upper && !is_equality &&
      !(bounded.lower->nominal() < bounded.upper->nominal()))
    item.fail("the lower bound, " + to_decimal(bounded.lower->nominal()) +
                  ", must be less than the upper one, " + to_decimal(bounded.upper->nominal()) +
                  ", at the parameters' start",
              "lower < upper, or twice the same number for an equality");
  const auto add = [&](const std::string& text, const std::string& less, const std::string& more) {
    study->constraints.push_back(
        make_constraint(text, less, more, in.table.names, item.where(), item.path()));
  };
  const std::string middle = bounded.expression.expression()->text();
  if (is_equality) {
    const std::string number = text_of(*bounded.lower);
    add(middle + " == " + number, number, middle);
    study->constraints.back().is_equality = true;
    return;
  }
  if (bounded.lower) {
    const std::string number = text_of(*bounded.lower);
    add(middle + " >= " + number, number, middle);
  }
  if (bounded.upper) {
    const std::string number = text_of(*bounded.upper);
    add(middle + " <= " + number, middle, number);
  }
}

}  // namespace

const char* bounded_measure(const YamlValue& item) {
  if (!item.is_map()) return nullptr;
  if (item.find("peak")) return "peak";
  for (const char* measure : kMeasureNames)
    if (item.find(measure)) return measure;
  return nullptr;
}

std::vector<EntryForm> forms_of_constraints() { return {{"constraints[]", expression_keys()}}; }

void read_constraints(const YamlValue& study_value, const RobotDescription& robot,
                      const TrajectoryLoader& loader, Study* study) {
  const auto constraints = study_value.find("constraints");
  if (!constraints) return;
  // A table of its own, since reading a constraint must not mark its parameters as used: a
  // constraint moves nothing.
  const ParameterTable table(study->parameters);
  const EntryContext in{robot, table, loader, *study};
  for (const YamlValue& item : constraints->items()) {
    if (bounded_measure(item) || is_linear_item(item)) continue;
    if (item.is_list() || (item.is_map() && !item.find("expression")))
      item.fail("not a constraint", kFormsOfConstraints);
    if (item.is_map())
      read_bounded_expression(item, in, study);
    else
      study->constraints.push_back(
          parse_constraint(item.text(), table.names, item.where(), item.path()));
  }
}

}  // namespace codesign
