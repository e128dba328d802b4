// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "codegen/traced.h"
#include "description/expression_syntax.h"
#include "math/arrays.h"

namespace codesign {
namespace {

using Complex = std::complex<double>;

Complex extreme(In<Complex> z, double sign) {
  Complex best = z[0];
  for (const Complex& one : z)
    if (sign * one.real() > sign * best.real()) best = one;
  return best;
}

/// value + i slope Im z: a function with this value and slope, applied to a complex step, to first
/// order. Unlike the analytic continuation this gives an infinite derivative at an end of the
/// domain where the slope is infinite.
Complex first_order(const Complex& z, double value, double slope) {
  return {value, z.imag() == 0.0 ? 0.0 : slope * z.imag()};
}

Complex square_root(In<Complex> z) {
  const double x = z[0].real(), root = std::sqrt(x);
  return x >= 0.0 ? first_order(z[0], root, 0.5 / root) : std::sqrt(z[0]);
}

Complex arc_sine(In<Complex> z) {
  const double x = z[0].real();
  return std::abs(x) <= 1.0 ? first_order(z[0], std::asin(x), 1.0 / std::sqrt(1.0 - x * x))
                            : std::asin(z[0]);
}

Complex arc_cosine(In<Complex> z) {
  const double x = z[0].real();
  return std::abs(x) <= 1.0 ? first_order(z[0], std::acos(x), -1.0 / std::sqrt(1.0 - x * x))
                            : std::acos(z[0]);
}

Complex arc_tangent2(In<Complex> z) {
  const double y = z[0].real(), x = z[1].real();
  if (z[0].imag() == 0.0 && z[1].imag() == 0.0)
    return std::atan2(y, x);  // defined at the origin too, where the derivative is not
  return {std::atan2(y, x), (x * z[0].imag() - y * z[1].imag()) / (x * x + y * y)};
}

double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

using Code = ExpressionStep::Code;
using Complex = std::complex<double>;

Complex combine(Code code, const Complex& a, const Complex& b) {
  const Complex pair[2] = {a, b};
  switch (code) {
    case Code::kAdd:
      return a + b;
    case Code::kSubtract:
      return a - b;
    case Code::kMultiply:
      return a.imag() == 0.0 && b.imag() == 0.0 ? Complex(a.real() * b.real())
                                                : a * b;  // complex products lose the sign of zero
    case Code::kDivide:
      return expression_quotient(a, b);
    case Code::kPower:
      return expression_power(pair);
    case Code::kLess:
      return a.real() < b.real() ? 1.0 : 0.0;
    case Code::kLessOrEqual:
      return a.real() <= b.real() ? 1.0 : 0.0;
    case Code::kGreater:
      return a.real() > b.real() ? 1.0 : 0.0;
    case Code::kGreaterOrEqual:
      return a.real() >= b.real() ? 1.0 : 0.0;
    case Code::kEqual:
      return a.real() == b.real() ? 1.0 : 0.0;
    default:
      return a.real() != b.real() ? 1.0 : 0.0;
  }
}

/// The change of the stack's size by a step.
int growth(const ExpressionStep& step) {
  switch (step.code) {
    case Code::kConstant:
    case Code::kVariable:
      return 1;
    case Code::kNegate:
    case Code::kJump:
      return 0;
    case Code::kCall:
      return 1 - step.count;
    default:
      return -1;
  }
}

using Complex = std::complex<double>;
constexpr double kStep = 1e-30;

UsedNumbers<Complex> complex_numbers(In<double> values) {
  UsedNumbers<Complex> numbers(to_index(values.size()));
  for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = values[to_signed(k)];
  return numbers;
}

double real_part(const Complex& value) {
  return value.imag() == 0.0 ? value.real() : std::numeric_limits<double>::quiet_NaN();
}

using Code = ExpressionStep::Code;

/// The range of four products or quotients of ends; all numbers if one is undefined, such as 0 *
/// infinity.
ValueRange hull(std::initializer_list<double> ends) {
  if (std::any_of(ends.begin(), ends.end(), [](double end) { return std::isnan(end); })) return {};
  return {std::min(ends), std::max(ends)};
}

ValueRange combine(Code code, const ValueRange& a, const ValueRange& b) {
  switch (code) {
    case Code::kAdd:
      return hull({a.lower + b.lower, a.upper + b.upper});
    case Code::kSubtract:
      return hull({a.lower - b.upper, a.upper - b.lower});
    case Code::kMultiply:
      return hull({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
    default:
      if (b.lower <= 0.0 && b.upper >= 0.0) return {};
      return hull({a.lower / b.lower, a.lower / b.upper, a.upper / b.lower, a.upper / b.upper});
  }
}

}  // namespace

std::complex<double> expression_power(In<std::complex<double>> z) {
  const Complex base = z[0], exponent = z[1];
  const double n = exponent.real();
  if (exponent.imag() == 0.0 && base.imag() == 0.0) return std::pow(base.real(), n);
  // n x^(n-1) keeps the derivative of an integer power exact at zero and for negative bases, where
  // exp(n log x) is not.
  if (exponent.imag() == 0.0)
    return {std::pow(base.real(), n),
            n == 0.0 ? 0.0 : n * std::pow(base.real(), n - 1.0) * base.imag()};
  return std::pow(base, exponent);
}

std::complex<double> expression_quotient(std::complex<double> a, std::complex<double> b) {
  return a.imag() == 0.0 && b.imag() == 0.0 ? Complex(a.real() / b.real()) : a / b;
}

const std::vector<ExpressionFunction>& expression_function_table() {
  static const std::vector<ExpressionFunction> kTable = {
      {"sqrt", 1, square_root, FunctionKind::kSquareRoot},
      {"sin", 1, [](In<Complex> z) { return std::sin(z[0]); }, FunctionKind::kSine},
      {"cos", 1, [](In<Complex> z) { return std::cos(z[0]); }, FunctionKind::kCosine},
      {"tan", 1, [](In<Complex> z) { return std::tan(z[0]); }, FunctionKind::kTangent},
      {"asin", 1, arc_sine, FunctionKind::kArcSine},
      {"acos", 1, arc_cosine, FunctionKind::kArcCosine},
      {"atan", 1, [](In<Complex> z) { return std::atan(z[0]); }, FunctionKind::kArcTangent},
      {"atan2", 2, arc_tangent2, FunctionKind::kArcTangent2},
      {"sinh", 1, [](In<Complex> z) { return std::sinh(z[0]); }, FunctionKind::kHyperbolicSine},
      {"cosh", 1, [](In<Complex> z) { return std::cosh(z[0]); }, FunctionKind::kHyperbolicCosine},
      {"tanh", 1, [](In<Complex> z) { return std::tanh(z[0]); }, FunctionKind::kHyperbolicTangent},
      {"exp", 1, [](In<Complex> z) { return std::exp(z[0]); }, FunctionKind::kExponential},
      {"log", 1, [](In<Complex> z) { return std::log(z[0]); }, FunctionKind::kLogarithm},
      {"log10", 1, [](In<Complex> z) { return std::log10(z[0]); }, FunctionKind::kLogarithm10},
      {"pow", 2, expression_power, FunctionKind::kPower},
      {"abs", 1, [](In<Complex> z) { return z[0].real() >= 0.0 ? z[0] : -z[0]; },
       FunctionKind::kMagnitude},
      {"sign", 1, [](In<Complex> z) { return Complex(sign_of(z[0].real())); }, FunctionKind::kSign},
      {"min", -1, [](In<Complex> z) { return extreme(z, -1.0); }, FunctionKind::kLeast},
      {"max", -1, [](In<Complex> z) { return extreme(z, 1.0); }, FunctionKind::kGreatest},
      {"floor", 1, [](In<Complex> z) { return Complex(std::floor(z[0].real())); },
       FunctionKind::kFloor},
      {"ceil", 1, [](In<Complex> z) { return Complex(std::ceil(z[0].real())); },
       FunctionKind::kCeiling},
      {"radians", 1, [](In<Complex> z) { return z[0] * (M_PI / 180.0); }, FunctionKind::kRadians},
      {"degrees", 1, [](In<Complex> z) { return z[0] * (180.0 / M_PI); }, FunctionKind::kDegrees},
  };
  return kTable;
}

int find_expression_function(const std::string& name) {
  const std::vector<ExpressionFunction>& table = expression_function_table();
  for (std::size_t k = 0; k < table.size(); ++k)
    if (name == table[k].name) return static_cast<int>(k);
  return -1;
}

// The two branches of `?:` are counted as if both were executed, which gives one number more than
// is needed.
int stack_size(const ExpressionSteps& steps) {
  int size = 0, largest = 0;
  for (const ExpressionStep& step : steps) {
    size += growth(step);
    largest = std::max(largest, size);
  }
  return largest;
}

std::complex<double> run(const ExpressionSteps& steps, In<std::complex<double>> variables,
                         Out<std::complex<double>> stack) {
  Complex* top = stack.data();  // past the topmost number
  for (std::size_t at = 0; at < steps.size(); ++at) {
    const ExpressionStep& step = steps[at];
    switch (step.code) {
      case Code::kConstant:
        *top++ = step.number;
        break;
      case Code::kVariable:
        *top++ = variables[step.index];
        break;
      case Code::kNegate:
        top[-1] = -top[-1];
        break;
      case Code::kCall: {
        top -= step.count;
        const Complex value =
            expression_function_table()[to_index(step.index)].law({top, step.count});
        *top++ = value;
        break;
      }
      case Code::kJumpUnless:
        if (*--top == 0.0) at = to_index(step.index) - 1;
        break;
      case Code::kJump:
        at = to_index(step.index) - 1;
        break;
      default:
        --top;
        top[-1] = combine(step.code, top[-1], *top);
    }
  }
  return stack[0];
}

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
  const auto stack = to_index(stack_size(parsed.steps));
  program_ = std::make_unique<const Program>(Program{std::move(parsed.steps), stack});
}

const ExpressionSteps& Expression::steps() const { return program_->steps; }

Expression::~Expression() = default;

double Expression::value(const std::vector<double>& parameters) const {
  return real_part(
      program_->evaluate(used<Complex>(parameters, [](double parameter) { return parameter; })));
}

std::complex<double> Expression::value(const std::vector<std::complex<double>>& parameters) const {
  return program_->evaluate(
      used<Complex>(parameters, [](const Complex& parameter) { return parameter; }));
}

double Expression::derivative(int index, const std::vector<double>& parameters) const {
  const auto found = std::lower_bound(dependencies_.begin(), dependencies_.end(), index);
  if (found == dependencies_.end() || *found != index) return 0.0;
  return derivative_of(to_index(found - dependencies_.begin()),
                       used<double>(parameters, [](double parameter) { return parameter; }));
}

double Expression::value_of(In<double> values) const {
  return real_part(program_->evaluate(complex_numbers(values)));
}

ValueRange Expression::range(const std::vector<ValueRange>& parameters) const {
  std::vector<ValueRange> values;
  values.reserve(dependencies_.size());
  for (int index : dependencies_) values.push_back(parameters.at(to_index(index)));
  return range_of(program_->steps, values);
}

double Expression::derivative_of(std::size_t k, In<double> values) const {
  UsedNumbers<Complex> variables = complex_numbers(values);
  variables[k] += Complex(0.0, kStep);
  return program_->evaluate(variables).imag() / kStep;
}

ValueRange range_of(const ExpressionSteps& steps, In<ValueRange> variables) {
  std::vector<ValueRange> stack;
  for (const ExpressionStep& step : steps) {
    switch (step.code) {
      case Code::kConstant:
        stack.push_back({step.number, step.number});
        break;
      case Code::kVariable:
        stack.push_back(variables[step.index]);
        break;
      case Code::kNegate:
        stack.back() = {-stack.back().upper, -stack.back().lower};
        break;
      case Code::kAdd:
      case Code::kSubtract:
      case Code::kMultiply:
      case Code::kDivide: {
        const ValueRange right = stack.back();
        stack.pop_back();
        stack.back() = combine(step.code, stack.back(), right);
        break;
      }
      default:
        return {};
    }
  }
  return stack.back();
}

Traced value_at(const Expression& expression, const std::vector<Traced>& parameters) {
  Recording* const recording = parameters.front().recording();
  const UsedNumbers<double> values = expression.used<double>(
      parameters, [](const Traced& parameter) { return parameter.value(); });
  return {recording, recording->supplied(SourceId(expression)), expression.value_of(values)};
}

}  // namespace codesign
