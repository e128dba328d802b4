// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression.h"

#include <algorithm>
#include <limits>

#include "description/expression_syntax.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

UsedNumbers<Complex> complex_numbers(In<double> values) {
  UsedNumbers<Complex> numbers(static_cast<std::size_t>(values.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = values[static_cast<std::ptrdiff_t>(k)];
  return numbers;
}

double real_part(const Complex& value) { return value.imag() == 0.0 ? value.real() : std::numeric_limits<double>::quiet_NaN(); }

}  // namespace

struct Expression::Program {
  ExpressionSteps steps;
  std::size_t stack = 0;

  Complex evaluate(In<Complex> variables) const {
    UsedNumbers<Complex> numbers(stack);
    return run(steps, variables, numbers);
  }
};

Expression::Expression(const std::string& text, const std::vector<std::string>& names)
    : Expression(text, ExpressionScope{[&names](const std::string& name) {
                                         const auto found = std::find(names.begin(), names.end(), name);
                                         return found == names.end() ? -1 : static_cast<int>(found - names.begin());
                                       },
                                       [&names] { return names; }}) {}

Expression::Expression(const std::string& text, const ExpressionScope& scope) : text_(text) {
  ParsedExpression parsed = parse_expression(text, scope);
  dependencies_ = std::move(parsed.dependencies);
  const auto stack = static_cast<std::size_t>(stack_size(parsed.steps));
  program_ = std::make_unique<const Program>(Program{std::move(parsed.steps), stack});
}

Expression::~Expression() = default;

double Expression::value(const std::vector<double>& parameters) const {
  return real_part(program_->evaluate(used<Complex>(parameters, [](double parameter) { return parameter; })));
}

std::complex<double> Expression::value(const std::vector<std::complex<double>>& parameters) const {
  return program_->evaluate(used<Complex>(parameters, [](const Complex& parameter) { return parameter; }));
}

double Expression::derivative(int index, const std::vector<double>& parameters) const {
  const auto found = std::lower_bound(dependencies_.begin(), dependencies_.end(), index);
  if (found == dependencies_.end() || *found != index) return 0.0;
  return derivative_of(static_cast<std::size_t>(found - dependencies_.begin()),
                       used<double>(parameters, [](double parameter) { return parameter; }));
}

double Expression::value_of(In<double> values) const { return real_part(program_->evaluate(complex_numbers(values))); }

ValueRange Expression::range(const std::vector<ValueRange>& parameters) const {
  std::vector<ValueRange> values;
  values.reserve(dependencies_.size());
  for (int index : dependencies_) values.push_back(parameters.at(static_cast<std::size_t>(index)));
  return range_of(program_->steps, values);
}

double Expression::derivative_of(std::size_t k, In<double> values) const {
  UsedNumbers<Complex> variables = complex_numbers(values);
  variables[k] += Complex(0.0, kStep);
  return program_->evaluate(variables).imag() / kStep;
}

}  // namespace codesign
