// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "description/expression.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "math/taylor.h"

namespace codesign {

/// A number on the stack of evaluate_formula().
template <class T>
struct FormulaNumber {
  T value{0.0};
  bool is_constant = false;  ///< a number of the text, so that a power of it is known
  double constant = 0.0;
};

/// base^exponent for a whole number.
template <class T>
T whole_power(const T& base, int exponent) {
  if (exponent < 0) return T(1.0) / whole_power(base, -exponent);
  T result(1.0), factor = base;
  for (; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) result = result * factor;
    factor = factor * factor;
  }
  return result;
}

/// base^exponent: products for whole numbers of the text, else exp(exponent log base), which needs
/// a positive base.
template <class T>
T formula_power(const FormulaNumber<T>& base, const FormulaNumber<T>& exponent) {
  using std::exp;
  using std::log;
  constexpr double kMostFactors = 64.0;
  const double n = exponent.constant;
  if (exponent.is_constant && std::nearbyint(n) == n && std::abs(n) <= kMostFactors)
    return whole_power(base.value, static_cast<int>(n));
  return exp(exponent.value * log(base.value));
}

/// The smallest of some numbers, or with `largest` the largest.
template <class T>
T formula_extreme(const FormulaNumber<T>* first, int count, bool largest) {
  T best = first[0].value;
  for (int k = 1; k < count; ++k) {
    const T& one = first[k].value;
    if (largest ? is_below(best, one, false) : is_below(one, best, false)) best = one;
  }
  return best;
}

/// The next whole number below x, or with `above` the next above.
template <class T>
T whole_number(const T& x, bool above) {
  return above ? T(-whole_below(T(-x))) : whole_below(x);
}

/// A function of ExpressionFunction, for any scalar that formulas are evaluated or recorded with.
template <class T>
T formula_function(FunctionKind kind, const FormulaNumber<T>* z, int count) {
  using std::asin, std::cos, std::exp, std::log, std::sin, std::sqrt, std::tanh;
  using K = FunctionKind;
  const T& x = z[0].value;
  const T zero(0.0), one(1.0), half(0.5);
  switch (kind) {
    case K::kSquareRoot:
      return sqrt(x);
    case K::kSine:
      return sin(x);
    case K::kCosine:
      return cos(x);
    case K::kTangent:
      return sin(x) / cos(x);
    case K::kArcSine:
      return asin(x);
    case K::kArcCosine:
      return T(0.5 * M_PI) - asin(x);
    case K::kArcTangent:
      return arc_tangent(x, one);
    case K::kArcTangent2:
      return arc_tangent(x, z[1].value);
    case K::kHyperbolicSine:
      return half * (exp(x) - exp(-x));
    case K::kHyperbolicCosine:
      return half * (exp(x) + exp(-x));
    case K::kHyperbolicTangent:
      return tanh(x);
    case K::kExponential:
      return exp(x);
    case K::kLogarithm:
      return log(x);
    case K::kLogarithm10:
      return log(x) * T(1.0 / M_LN10);
    case K::kPower:
      return formula_power(z[0], z[1]);
    case K::kMagnitude:
      return is_below(x, zero, false) ? T(-x) : x;
    case K::kSign:
      return is_below(x, zero, false) ? T(-1.0) : is_below(zero, x, true) ? one : zero;
    case K::kLeast:
    case K::kGreatest:
      return formula_extreme(z, count, kind == K::kGreatest);
    case K::kFloor:
    case K::kCeiling:
      return whole_number(x, kind == K::kCeiling);
    case K::kRadians:
      return x * T(M_PI / 180.0);
    case K::kDegrees:
      break;
  }
  return x * T(180.0 / M_PI);
}

template <class T>
bool formula_comparison(ExpressionStep::Code code, const T& a, const T& b) {
  using Code = ExpressionStep::Code;
  switch (code) {
    case Code::kLess:
      return is_below(a, b, false);
    case Code::kLessOrEqual:
      return !is_below(b, a, false);
    case Code::kGreater:
      return is_below(b, a, false);
    case Code::kGreaterOrEqual:
      return !is_below(a, b, false);
    default: {
      const bool equal = !is_below(a, b, false) && !is_below(b, a, false);
      return (code == Code::kEqual) == equal;
    }
  }
}

/// An operator with two operands.
template <class T>
FormulaNumber<T> formula_operation(ExpressionStep::Code code, const FormulaNumber<T>& a,
                                   const FormulaNumber<T>& b) {
  using Code = ExpressionStep::Code;
  switch (code) {
    case Code::kAdd:
      return {a.value + b.value};
    case Code::kSubtract:
      return {a.value - b.value};
    case Code::kMultiply:
      return {a.value * b.value};
    case Code::kDivide:
      return {a.value / b.value};
    case Code::kPower:
      return {formula_power(a, b)};
    default: {
      const double truth = formula_comparison(code, a.value, b.value) ? 1.0 : 0.0;
      return {T(truth), true, truth};
    }
  }
}

/// Whether an expression has a comparison or a function with a kink or a jump.
inline bool has_switches(const ExpressionSteps& steps) {
  using Code = ExpressionStep::Code;
  using K = FunctionKind;
  return std::any_of(steps.begin(), steps.end(), [](const ExpressionStep& step) {
    if (step.code == Code::kJumpUnless) return true;
    if (step.code != Code::kCall) return false;
    const K kind = expression_function_table()[to_index(step.index)].kind;
    return kind == K::kMagnitude || kind == K::kSign || kind == K::kLeast ||
           kind == K::kGreatest || kind == K::kFloor || kind == K::kCeiling;
  });
}

/// The value of an expression for any scalar: double for observers, Traced to record it, Taylor for
/// functions of time. Comparisons and functions with branches decide by is_below().
/// @param variables their values, by index.
template <class T>
T evaluate_formula(const ExpressionSteps& steps, const std::vector<T>& variables) {
  using Code = ExpressionStep::Code;
  std::vector<FormulaNumber<T>> stack;
  stack.reserve(to_index(stack_size(steps)));
  for (std::size_t at = 0; at < steps.size(); ++at) {
    const ExpressionStep& step = steps[at];
    switch (step.code) {
      case Code::kConstant:
        stack.push_back({T(step.number), true, step.number});
        break;
      case Code::kVariable:
        stack.push_back({variables[to_index(step.index)]});
        break;
      case Code::kNegate:
        stack.back() = {-stack.back().value, stack.back().is_constant, -stack.back().constant};
        break;
      case Code::kCall: {
        const std::size_t first = stack.size() - to_index(step.count);
        const T value = formula_function(expression_function_table()[to_index(step.index)].kind,
                                         &stack[first], step.count);
        stack.resize(first);
        stack.push_back({value});
        break;
      }
      case Code::kJumpUnless:
        if (stack.back().constant == 0.0) at = to_index(step.index) - 1;
        stack.pop_back();
        break;
      case Code::kJump:
        at = to_index(step.index) - 1;
        break;
      default: {
        const FormulaNumber<T> right = stack.back();
        stack.pop_back();
        stack.back() = formula_operation(step.code, stack.back(), right);
      }
    }
  }
  return stack.back().value;
}

/// The Taylor polynomial of an expression of the time at time t [s]. @param time index of the time
/// among the names of the formula. @param used the numbers of its dependencies; that of the time
/// does not count.
template <class T>
Taylor<T> time_series(const Expression& formula, int time, const std::vector<T>& used, double t) {
  std::vector<Taylor<T>> variables;
  variables.reserve(used.size());
  for (std::size_t k = 0; k < used.size(); ++k)
    variables.push_back(formula.dependencies()[k] == time ? Taylor<T>::time(T(t))
                                                          : Taylor<T>(used[k]));
  return evaluate_formula<Taylor<T>>(formula.steps(), variables);
}

}  // namespace codesign
