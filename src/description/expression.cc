// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression.h"

#include <algorithm>

#include "codegen/number_types.h"
#include "codegen/traced.h"
#include "description/expression_syntax.h"
#include "description/formula.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Code = ExpressionStep::Code;
using Complex = std::complex<double>;

/// The change of the stack's size by a step.
int growth(const ExpressionStep& step) {
  switch (step.code) {
    case Code::kConstant:
    case Code::kVariable:
      return 1;
    case Code::kNegate:
      return 0;
    case Code::kCall:
      return 1 - step.count;
    default:
      return -1;
  }
}

template <class T>
T same(const T& x) {
  return x;
}

}  // namespace

const std::vector<ExpressionFunction>& expression_function_table() {
  static const std::vector<ExpressionFunction> kTable = {
      {"sqrt", 1, FunctionKind::kSquareRoot},
      {"sin", 1, FunctionKind::kSine},
      {"cos", 1, FunctionKind::kCosine},
      {"tan", 1, FunctionKind::kTangent},
      {"asin", 1, FunctionKind::kArcSine},
      {"acos", 1, FunctionKind::kArcCosine},
      {"atan", 1, FunctionKind::kArcTangent},
      {"atan2", 2, FunctionKind::kArcTangent2},
      {"sinh", 1, FunctionKind::kHyperbolicSine},
      {"cosh", 1, FunctionKind::kHyperbolicCosine},
      {"tanh", 1, FunctionKind::kHyperbolicTangent},
      {"exp", 1, FunctionKind::kExponential},
      {"log", 1, FunctionKind::kLogarithm},
      {"log10", 1, FunctionKind::kLogarithm10},
      {"pow", 2, FunctionKind::kPower},
      {"abs", 1, FunctionKind::kMagnitude},
      {"sign", 1, FunctionKind::kSign},
      {"min", -1, FunctionKind::kLeast},
      {"max", -1, FunctionKind::kGreatest},
      {"floor", 1, FunctionKind::kFloor},
      {"ceil", 1, FunctionKind::kCeiling},
      {"radians", 1, FunctionKind::kRadians},
      {"degrees", 1, FunctionKind::kDegrees},
  };
  return kTable;
}

int find_expression_function(const std::string& name) {
  const std::vector<ExpressionFunction>& table = expression_function_table();
  for (std::size_t k = 0; k < table.size(); ++k)
    if (name == table[k].name) return static_cast<int>(k);
  return -1;
}

std::string text_of(const ExpressionSteps& steps, int step, const std::string& text) {
  if (step < 0 || to_index(step) >= steps.size()) return text;
  const ExpressionStep& of = steps[to_index(step)];
  return of.end > of.begin ? text.substr(to_index(of.begin), to_index(of.end - of.begin)) : text;
}

// Both branches of `?:` are counted, one after the other: the jump behind the first one takes back
// its value.
int stack_size(const ExpressionSteps& steps) {
  int size = 0, largest = 0;
  for (const ExpressionStep& step : steps) {
    size += growth(step);
    largest = std::max(largest, size);
  }
  return largest;
}

Expression::Expression(const std::string& text, const std::vector<std::string>& names)
    : Expression(text, ExpressionScope{[&names](const std::string& name) {
                                         const auto found =
                                             std::find(names.begin(), names.end(), name);
                                         return found == names.end()
                                                    ? -1
                                                    : static_cast<int>(found - names.begin());
                                       },
                                       [&names] { return names; }}) {}

Expression::Expression(const std::string& text, const ExpressionScope& scope) : text_(text) {
  ParsedExpression parsed = parse_expression(text, scope);
  dependencies_ = std::move(parsed.dependencies);
  steps_ = std::move(parsed.steps);
  stack_ = to_index(stack_size(steps_));
}

template <class T>
T Expression::evaluate(In<T> values) const {
  UsedNumbers<T> stack(stack_);
  return evaluate_formula<T>(steps_, values, Out<T>(stack));
}

double Expression::value(const std::vector<double>& parameters) const {
  return evaluate<double>(used<double>(parameters, same<double>));
}

std::complex<double> Expression::value(const std::vector<std::complex<double>>& parameters) const {
  return evaluate<Complex>(used<Complex>(parameters, same<Complex>));
}

double Expression::derivative(int index, const std::vector<double>& parameters) const {
  const auto found = std::lower_bound(dependencies_.begin(), dependencies_.end(), index);
  if (found == dependencies_.end() || *found != index) return 0.0;
  return derivative_of(to_index(found - dependencies_.begin()),
                       used<double>(parameters, same<double>));
}

double Expression::derivative_of(std::size_t k, In<double> values) const {
  UsedNumbers<Complex> variables(to_index(values.size()));
  for (std::size_t j = 0; j < variables.size(); ++j) variables[j] = values[to_signed(j)];
  variables[k] += Complex(0.0, 1.0);
  return evaluate<Complex>(variables).imag();
}

ValueRange Expression::range(const std::vector<ValueRange>& parameters) const {
  return evaluate<ValueRange>(used<ValueRange>(parameters, same<ValueRange>));
}

Traced value_at(const Expression& expression, const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  const UsedNumbers<double> values = expression.used<double>(
      parameters, [](const Traced& parameter) { return parameter.value(); });
  return {recording, recording->supplied(SourceId(expression)), expression.value_of(values)};
}

#define CODESIGN_INSTANTIATE(T) template T Expression::evaluate<T>(In<T> values) const;
CODESIGN_FOR_EACH_VALUE_TYPE(CODESIGN_INSTANTIATE)
CODESIGN_INSTANTIATE(ValueRange)
#undef CODESIGN_INSTANTIATE

}  // namespace codesign
