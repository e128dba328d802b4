// Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_program.h"

#include <algorithm>

#include "description/expression_functions.h"

namespace codesign {
namespace {

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
      return a.imag() == 0.0 && b.imag() == 0.0 ? Complex(a.real() * b.real()) : a * b;  // complex products lose the sign of zero
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

}  // namespace

// The two branches of `?:` are counted as if both were executed, which gives one number more than is needed.
int stack_size(const ExpressionSteps& steps) {
  int size = 0, largest = 0;
  for (const ExpressionStep& step : steps) {
    size += growth(step);
    largest = std::max(largest, size);
  }
  return largest;
}

std::complex<double> run(const ExpressionSteps& steps, In<std::complex<double>> variables, Out<std::complex<double>> stack) {
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
        const Complex value = expression_function_table()[static_cast<std::size_t>(step.index)].law({top, step.count});
        *top++ = value;
        break;
      }
      case Code::kJumpUnless:
        if (*--top == 0.0) at = static_cast<std::size_t>(step.index) - 1;
        break;
      case Code::kJump:
        at = static_cast<std::size_t>(step.index) - 1;
        break;
      default:
        --top;
        top[-1] = combine(step.code, top[-1], *top);
    }
  }
  return stack[0];
}

}  // namespace codesign
