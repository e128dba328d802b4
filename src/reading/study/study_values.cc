// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "reading/study/study_values.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "description/formula.h"
#include "description/tuned_parameters.h"
#include "math/arrays.h"
#include "mechanism/signal_catalog.h"
#include "reading/study/entry_keys.h"
#include "text/nearest_name.h"
#include "text/number_text.h"

namespace codesign {

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

int untuned_parameter(const std::string& name, const Study& study, const YamlValue& at,
                      const std::vector<std::string>& others) {
  return untuned_parameter(name, study, at.where(), at.path(), others);
}

int untuned_parameter(const std::string& name, const Study& study, const SourceLocation& where,
                      const std::string& element, const std::vector<std::string>& others) {
  std::vector<std::string> allowed = others;
  const std::set<int> tuned(study.tuned.begin(), study.tuned.end());
  for (int index = 0; index < static_cast<int>(study.parameters.size()); ++index) {
    const std::string& known = study.parameters[to_index(index)].name;
    const bool is_tuned = tuned.count(index) > 0;
    if (known == name && !is_tuned) return index;
    if (known == name) throw tuned_error(where, element, name);
    if (!is_tuned) allowed.push_back(known);
  }
  throw unknown_name(where, element, "parameter", name, allowed);
}

void require_within_bounds(double value, const Parameter& parameter, const SourceLocation& where,
                           const std::string& element) {
  if (std::isfinite(value) && parameter.lower <= value && value <= parameter.upper) return;
  throw InputError({where, element,
                    "the value lies outside the bounds of the parameter " + parameter.name,
                    to_decimal(value), range_of(parameter)});
}

double read_within_bounds(const YamlValue& value, const Parameter& parameter) {
  const double number = value.number();
  require_within_bounds(number, parameter, value.where(), value.path());
  return number;
}

void require_known(const SignalDescription& signal, const std::vector<std::string>& parameters,
                   const SourceLocation& where, const std::string& element) {
  if (!signal.formula) return;
  std::vector<std::string> known = parameters;
  known.emplace_back("t");
  for (const std::string& name : signal.formula->names)
    if (name.find('/') == std::string::npos &&
        std::find(known.begin(), known.end(), name) == known.end())
      throw unknown_name(where, element, "parameter", name, known);
}

double read_above_zero(const YamlValue& value, const std::string& unit) {
  const double number = value.number();
  if (!(number > 0.0)) value.fail("not above zero", "more than 0" + unit);
  return number;
}

bool is_expression(const std::string& text) {
  return text.size() >= 4 && text.compare(0, 2, "${") == 0 && text.back() == '}';
}

std::string expression_in(const std::string& text) { return text.substr(2, text.size() - 3); }

Quantity read_quantity(const YamlValue& value, const ParameterTable& table) {
  constexpr const char* kAllowed = "a finite number or \"${expression}\" of the parameters";
  const std::string text = value.text();
  if (const std::optional<double> number = number_in(text)) {
    if (!std::isfinite(*number)) value.fail("not finite", kAllowed);
    return *number;
  }
  if (!is_expression(text)) value.fail("not a number", kAllowed);
  std::shared_ptr<const Expression> expression;
  try {
    expression = table.parse(expression_in(text));
  } catch (const std::invalid_argument& error) {
    value.fail(error.what(), kAllowed);
  }
  const double nominal = expression->value(table.values);
  if (!std::isfinite(nominal)) value.fail("not finite at the parameters' start", kAllowed);
  return Quantity(nominal, std::move(expression));
}

void use_parameters(const SignalDescription& signal, const ParameterTable& table) {
  if (!signal.formula) return;
  for (const std::string& name : signal.formula->names)
    if (const auto found = table.index.find(name); found != table.index.end())
      table.used.insert(found->second);
  for (ParameterSwitch& one : switches_of(signal, table, false))
    table.switches.push_back(std::move(one));
}

std::vector<ParameterSwitch> switches_of(const SignalDescription& signal,
                                         const ParameterTable& table, bool at_instant) {
  if (!signal.formula) return {};
  std::vector<ExpressionVariable> variables;
  for (const std::string& name : signal.formula->names) {
    const auto found = table.index.find(name);
    if (found != table.index.end())
      variables.push_back({VariableKind::kParameter, found->second});
    else
      variables.push_back({name == "t" ? VariableKind::kTime : VariableKind::kSignal, -1});
  }
  std::vector<ParameterSwitch> found = find_switches(
      signal.formula->steps, signal.formula->text, [&](int k) { return variables[to_index(k)]; },
      at_instant);
  // Any numbers, at which signals do not happen to cancel a jump.
  for (const double other : {0.37, -1.3})
    for (ParameterSwitch& one : found)
      one.values.emplace_back(
          [formula = signal.formula, variables, other](const std::vector<double>& parameters) {
            std::vector<double> values;
            for (const ExpressionVariable& variable : variables)
              values.push_back(variable.parameter < 0 ? other
                                                      : parameters[to_index(variable.parameter)]);
            return evaluate_formula<double>(formula->steps, In<double>(values));
          });
  return found;
}

void add_switches_at_instants(const ParameterTable& table, Study* study) {
  const auto add = [&](std::vector<ParameterSwitch> switches) {
    study->switches.insert(study->switches.end(), switches.begin(), switches.end());
  };
  for (const ObjectiveTerm& term : study->terminal) add(switches_of(term.signal, table, true));
  if (study->postures > 0)
    for (const ObjectiveTerm& term : study->integral) add(switches_of(term.signal, table, true));
  for (const WatchedSignal& watched : study->watched)
    if (!has_band(watched)) add(switches_of(watched.signal, table, true));
  constexpr int kInstants = 16;
  for (const ControllerDescription& controller : study->controllers) {
    const ControlRealization& realization = controller.realization;
    if (!realization.is_sampled()) continue;
    const auto look = [&](const ReferenceDescription& reference) {
      if (reference.kind != ReferenceDescription::Kind::kExpression) return;
      std::vector<double> times;
      for (int k = 0; k < kInstants; ++k)
        times.push_back(realization.sample_time *
                        std::floor(study->duration * k / kInstants / realization.sample_time));
      add(table.switches_of(reference.expression.formula, times, true));
    };
    look(controller.setpoint);
    look(controller.feedforward);
    for (const FeedbackTerm& term : controller.feedback) look(term.reference);
  }
}

QuantityVector read_vector(const YamlValue& value, const ParameterTable& table) {
  if (!value.is_list()) value.fail("three components are needed", "[x, y, z]");
  const std::vector<YamlValue> items = value.items();
  if (items.size() != 3)
    value.fail("three components are needed, found " + std::to_string(items.size()), "[x, y, z]");
  return {read_quantity(items[0], table), read_quantity(items[1], table),
          read_quantity(items[2], table)};
}

const JointDescription& scalar_joint(const std::string& name, const RobotDescription& robot,
                                     const YamlValue& at) {
  std::vector<std::string> known;
  for (const JointDescription& joint : robot.joints) {
    const bool scalar = joint.has_one_coordinate();
    if (joint.name == name && !scalar)
      at.fail("this joint has no single coordinate", "a revolute, continuous or prismatic joint");
    if (joint.name == name) return joint;
    if (scalar) known.push_back(joint.name);
  }
  throw unknown_name(at.where(), at.path(), "joint", name, known);
}

void require_bounds(const YamlValue& entry) {
  const bool has_lower = entry.find("at_least").has_value(),
             has_upper = entry.find("at_most").has_value();
  if (entry.find("between") ? has_lower || has_upper : !has_lower && !has_upper)
    entry.fail("a constraint needs bounds, either by between or by at_least and at_most",
               "between: [lower, upper]; or at_least, at_most or both");
}

}  // namespace codesign
