// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "description/expression.h"
#include "description/formula_laws.h"
#include "description/value_range.h"
#include "math/arrays.h"
#include "math/scalar.h"
#include "math/taylor.h"

namespace codesign {

/// The smallest of some numbers, or with `largest` the largest.
template <class T>
T formula_extreme(const T* first, int count, bool largest) {
  if (std::any_of(first, first + count, [](const T& x) { return takes_all_branches(x); }))
    return std::accumulate(first + 1, first + count, first[0]);
  T best = first[0];
  for (int k = 1; k < count; ++k) {
    const T& one = first[k];
    if (largest ? is_below(best, one, false) : is_below(one, best, false)) best = one;
  }
  return best;
}

/// The next whole number below x, or with `above` the next above.
template <class T>
T whole_number(const T& x, bool above) {
  return above ? T(-whole_below(T(-x))) : whole_below(x);
}

/// A function of expressions, for any scalar but ranges.
template <class T>
T formula_function(FunctionKind kind, const T* z, int count) {
  using K = FunctionKind;
  const T& x = z[0];
  const T zero(0.0), one(1.0);
  switch (kind) {
    case K::kArcTangent2:
      return angle_of(x, z[1]);
    case K::kPower:
      return power(x, z[1]);
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
    default:
      return smooth_function(kind, x);
  }
}

/// Whether a < b, as 1 or 0; of ranges as in description/value_range.h.
template <class T>
T less(const T& a, const T& b) {
  return T(is_below(a, b, false) ? 1.0 : 0.0);
}
/// Whether a = b. An undefined number (NaN) counts as equal to all: neither is less.
template <class T>
T equal(const T& a, const T& b) {
  return T(!is_below(a, b, false) && !is_below(b, a, false) ? 1.0 : 0.0);
}

template <class T>
T formula_comparison(ExpressionStep::Code code, const T& a, const T& b) {
  using Code = ExpressionStep::Code;
  const T one(1.0);
  switch (code) {
    case Code::kLess:
      return less(a, b);
    case Code::kLessOrEqual:
      return one - less(b, a);
    case Code::kGreater:
      return less(b, a);
    case Code::kGreaterOrEqual:
      return one - less(a, b);
    case Code::kEqual:
      return equal(a, b);
    default:
      return one - equal(a, b);
  }
}

/// An operator with two operands.
template <class T>
T formula_operation(ExpressionStep::Code code, const T& a, const T& b) {
  using Code = ExpressionStep::Code;
  switch (code) {
    case Code::kAdd:
      return a + b;
    case Code::kSubtract:
      return a - b;
    case Code::kMultiply:
      return product(a, b);
    case Code::kDivide:
      return quotient(a, b);
    case Code::kPower:
      return power(a, b);
    default:
      return formula_comparison(code, a, b);
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
    return kind == K::kMagnitude || kind == K::kSign || kind == K::kLeast || kind == K::kGreatest ||
           kind == K::kFloor || kind == K::kCeiling;
  });
}

/// Whether a condition may be true or false: of ranges.
template <class T>
bool is_open(const T&) {
  return false;
}
inline bool is_open(const ValueRange& truth) { return !truth.is_number(); }
/// What stands for the values of both branches.
template <class T>
T both(const T& one, const T& other) {
  return one + other;
}
inline ValueRange both(const ValueRange& one, const ValueRange& other) { return hull(one, other); }

/// The value of the steps from `first` to `last`, for any scalar. Comparisons and functions with
/// branches decide by is_below(). @param stack memory for stack_size() numbers.
template <class T>
T evaluate_steps(const ExpressionSteps& steps, std::size_t first, std::size_t last, In<T> variables,
                 Out<T> stack) {
  using Code = ExpressionStep::Code;
  const bool takes_all = std::any_of(variables.begin(), variables.end(),
                                     [](const T& x) { return takes_all_branches(x); });
  T* top = stack.data();  // past the topmost number
  for (std::size_t at = first; at < last; ++at) {
    const ExpressionStep& step = steps[at];
    switch (step.code) {
      case Code::kConstant:
        *top++ = T(step.number);
        break;
      case Code::kVariable:
        *top++ = variables[step.index];
        break;
      case Code::kNegate:
        top[-1] = -top[-1];
        break;
      case Code::kCall: {
        top -= step.count;
        for (int k = 0; k < step.count; ++k) name_part(top[k], static_cast<int>(at));
        const T value = formula_function(expression_function_table()[to_index(step.index)].kind,
                                         top, step.count);
        *top++ = value;
        break;
      }
      case Code::kJumpUnless: {
        const T truth = *--top;
        const auto second = to_index(step.index);
        if (takes_all || is_open(truth)) {
          const auto end = to_index(steps[second - 1].index);
          const Out<T> rest = stack.subspan(top - stack.data(), stack.end() - top);
          const T one = evaluate_steps<T>(steps, at + 1, second - 1, variables, rest);
          *top++ = both(one, evaluate_steps<T>(steps, second, end, variables, rest));
          at = end - 1;
          break;
        }
        if (is_zero(truth)) at = second - 1;
        break;
      }
      case Code::kJump:
        at = to_index(step.index) - 1;
        break;
      default: {
        --top;
        name_part(top[-1], static_cast<int>(at));
        name_part(*top, static_cast<int>(at));
        top[-1] = formula_operation(step.code, top[-1], *top);
      }
    }
  }
  return stack[0];
}

/// The value of an expression: double and numbers with derivatives for numbers of the model, Traced
/// to record it, Taylor for functions of time, ValueRange for all values over given ranges.
/// @param variables their values, by index. @param stack memory for stack_size() numbers.
template <class T>
T evaluate_formula(const ExpressionSteps& steps, In<T> variables, Out<T> stack) {
  return evaluate_steps<T>(steps, 0, steps.size(), variables, stack);
}
template <class T>
T evaluate_formula(const ExpressionSteps& steps, In<T> variables) {
  UsedNumbers<T> stack(to_index(stack_size(steps)));
  return evaluate_formula<T>(steps, variables, Out<T>(stack));
}

/// The Taylor polynomial of an expression of the time at time t [s]. @param time index of the time
/// among the names of the formula. @param used the numbers of its dependencies; that of the time
/// does not count.
template <class T>
Taylor<T> time_series(const Expression& formula, int time, const std::vector<T>& used, double t) {
  UsedNumbers<Taylor<T>> variables(used.size());
  for (std::size_t k = 0; k < used.size(); ++k)
    variables[k] = formula.dependencies()[k] == time ? Taylor<T>::time(T(t)) : Taylor<T>(used[k]);
  return evaluate_formula<Taylor<T>>(formula.steps(), variables);
}

}  // namespace codesign
