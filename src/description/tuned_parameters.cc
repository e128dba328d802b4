// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/tuned_parameters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/arrays.h"
#include "text/number_text.h"

namespace codesign {
namespace {

constexpr const char* kFormOfConstraint = "<expression> >= <expression>, or with <= or ==";

/// Positions of the `>=`, `<=` and `==` outside parentheses. Those inside belong to conditional
/// expressions.
std::vector<std::size_t> find_operators(const std::string& text) {
  std::vector<std::size_t> positions;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    const bool is_operator = (text[i] == '<' || text[i] == '>' || text[i] == '=') &&
                             i + 1 < text.size() && text[i + 1] == '=';
    if (!is_operator) continue;
    if (depth == 0) positions.push_back(i);
    ++i;
  }
  return positions;
}

}  // namespace

ParameterConstraint parse_constraint(const std::string& text, const std::vector<std::string>& names,
                                     const SourceLocation& where, const std::string& element) {
  const std::vector<std::size_t> operators = find_operators(text);
  if (operators.size() != 1)
    throw InputError(
        {where, element, "a constraint needs exactly one >=, <= or ==", text, kFormOfConstraint});
  const std::string left = text.substr(0, operators[0]);
  const std::string right = text.substr(operators[0] + 2);
  const char kind = text[operators[0]];
  try {
    ParameterConstraint constraint =
        kind == '>' ? make_constraint(text, right, left, names, where, element)
                    : make_constraint(text, left, right, names, where, element);
    constraint.is_equality = kind == '=';
    return constraint;
  } catch (const std::invalid_argument& error) {
    throw InputError({where, element, error.what(), text, kFormOfConstraint});
  }
}

ParameterConstraint make_constraint(const std::string& text, const std::string& less,
                                    const std::string& more, const std::vector<std::string>& names,
                                    const SourceLocation& where, const std::string& element) {
  // Check each side by itself: an empty or unbalanced side could still give a valid expression
  // together with the other side.
  for (const std::string& side : {less, more}) static_cast<void>(Expression(side, names));
  auto margin = std::make_shared<const Expression>("(" + more + ") - (" + less + ")", names);
  if (margin->dependencies().empty())
    throw std::invalid_argument("no parameter appears in the constraint");
  return {text, std::move(margin), false, where, element};
}

bool has_objective(const MotionStudy& study) {
  return !study.integral.empty() || !study.terminal.empty() ||
         std::any_of(study.watched.begin(), study.watched.end(), is_term);
}

bool needs_run(const MotionStudy& study) {
  const auto is_of_run = [](const WatchedSignal& watched) { return !watched.linear; };
  return !study.integral.empty() || !study.terminal.empty() || study.watched.empty() ||
         std::any_of(study.watched.begin(), study.watched.end(), is_of_run);
}

bool needs_linearization(const MotionStudy& study) {
  return !study.watched.empty() && study.watched.back().linear;
}

bool has_range(const Parameter& p) {
  return std::isfinite(p.lower) && std::isfinite(p.upper) && p.upper > p.lower;
}

double extent(const Parameter& p, double value) {
  if (has_range(p)) return p.upper - p.lower;
  return std::max(std::abs(value), p.value != 0.0 ? std::abs(p.value) : 1.0);
}

std::vector<double> start_parameters(const MotionStudy& study) {
  std::vector<double> values;
  values.reserve(study.parameters.size());
  for (const Parameter& parameter : study.parameters) values.push_back(parameter.value);
  return values;
}

std::vector<double> parameters_at(const MotionStudy& study, const Eigen::VectorXd& rho) {
  std::vector<double> values;
  parameters_at(study, rho, &values);
  return values;
}

void parameters_at(const MotionStudy& study, const Eigen::VectorXd& rho,
                   std::vector<double>* values) {
  values->clear();
  for (const Parameter& parameter : study.parameters) values->push_back(parameter.value);
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    (*values)[to_index(study.tuned[k])] = rho[to_signed(k)];
}

Eigen::VectorXd start_of(const MotionStudy& study) {
  Eigen::VectorXd rho(to_signed(study.tuned.size()));
  for (std::size_t k = 0; k < study.tuned.size(); ++k)
    rho[to_signed(k)] = study.parameters[to_index(study.tuned[k])].value;
  return rho;
}

const ControllerDescription* find_rounded(const Study& study) {
  for (const ControllerDescription& controller : study.controllers)
    if (controller.realization.quantization > 0.0) return &controller;
  for (const RunDescription& run : study.ensemble.runs)
    if (const ControllerDescription* controller = run.study ? find_rounded(*run.study) : nullptr)
      return controller;
  return nullptr;
}

void require_differentiable(const Study& study) {
  if (const ControllerDescription* rounded = find_rounded(study))
    throw InputError({rounded->where, "controllers." + rounded->name + ".quantization",
                      "a measurement that is rounded has no derivative: it can be simulated, but "
                      "neither differentiated nor optimized",
                      to_decimal(rounded->realization.quantization), "no quantization, or 0"});
}

void require_tuned(const Study& study) {
  require_differentiable(study);
  if (study.tuned.empty())
    throw InputError({{study.file, 1},
                      "parameters",
                      "the study tunes no parameter",
                      "",
                      "at least one parameter to tune"});
}

std::string range_of(const Parameter& parameter) {
  return "[" + to_decimal(parameter.lower) + ", " + to_decimal(parameter.upper) + "]";
}

InputError tuned_error(const SourceLocation& where, const std::string& element,
                       const std::string& name) {
  return InputError({where, element, "this parameter is tuned, so its value is the search's", name,
                     "a parameter that is not tuned"});
}

std::optional<InputFault> find_missing_bounds(const Parameter& parameter) {
  if (std::isfinite(parameter.lower) && std::isfinite(parameter.upper)) return std::nullopt;
  return InputFault{parameter.where, "parameter " + parameter.name,
                    "multistart needs finite bounds of all tuned parameters, and this one has " +
                        range_of(parameter),
                    "", "lower and upper, both given"};
}

const Parameter& tuned_parameter(const MotionStudy& study, Eigen::Index k) {
  return study.parameters[to_index(study.tuned[to_index(k)])];
}

std::string row_text(const ParameterChoice& choice, std::size_t row) {
  if (!choice.labels.empty()) return choice.labels[row];
  std::string text;
  for (const double value : choice.rows[row])
    text += (text.empty() ? "" : ", ") + to_decimal(value);
  return choice.parameters.size() > 1 ? "(" + text + ")" : text;
}

std::vector<Eigen::Index> places_of(const ParameterChoice& choice, const Study& study) {
  std::vector<Eigen::Index> places;
  for (const int parameter : choice.parameters) {
    const auto found = std::find(study.tuned.begin(), study.tuned.end(), parameter);
    if (found != study.tuned.end()) places.push_back(found - study.tuned.begin());
  }
  if (!places.empty() && places.size() < choice.parameters.size())
    throw InputError({choice.where, choice.element,
                      "some of the parameters of this list are tuned, and others are not",
                      choice.name, "all of them, or none"});
  return places;
}

std::vector<std::string> tuned_names(const MotionStudy& study) {
  std::vector<std::string> names;
  names.reserve(study.tuned.size());
  for (int index : study.tuned) names.push_back(study.parameters[to_index(index)].name);
  return names;
}

}  // namespace codesign
